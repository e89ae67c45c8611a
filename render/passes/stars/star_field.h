#pragma once

#include <glm/mat3x3.hpp>
#include <vector>

#include "content/stars/star_catalogue.h"
#include "kernels/sky/blackbody.h"
#include "kernels/stars/search/star_bands.h"
#include "render/passes/stars/drawing/shift_gains.h"

namespace ergodome {

//! Stars of a catalog, indexed by their position on the sky.
class StarField {
 public:
  //! `sky_from_equatorial`: rotation from equatorial J2000 to the hole's sky axes. `colours`, in
  //! host memory, gives the surface brightness from which stellar radii are computed. Stars without
  //! a measured color are taken as white (B-V = 0.3).
  StarField(const StarCatalogue& catalogue, const glm::dmat3& sky_from_equatorial, const BlackbodyTable& colours);

  //! Returns the stars, brightest first.
  [[nodiscard]] const std::vector<FieldStar>& stars() const { return stars_; }

  //! Returns the bounds of the brightness gain by frequency shifts.
  [[nodiscard]] const ShiftGains& gains() const { return gains_; }

  //! Returns the number of stars whose illuminance, times the gain of their color class for the
  //! threshold's frequency shift, is at least the threshold; the result may be slightly too large.
  [[nodiscard]] int count_from(const StarFloor& floor) const;

  //! Returns the field for kernels. put(vector) returns the address at which kernels read the
  //! vector: that of a copy, or of its own data.
  template <class Put>
  [[nodiscard]] SearchedField view(const Put& put) const {
    SearchedField field{};
    for (const Level& level : levels_) {
      field.levels[field.level_count++] = {{level.bands,
                                            level.cells,
                                            put(level.first),
                                            {put(level.direction[0]), put(level.direction[1]), put(level.direction[2])},
                                            put(level.illuminance)},
                                           put(level.number),
                                           put(level.colour),
                                           level.left_out};
    }
    field.stars = put(stars_);
    field.gains = put(gains_.rows());
    field.max_gain = put(max_gain_);
    return field;
  }

 private:
  //! One level of detail: the brightest stars, grouped into cells by their position on the sky.
  struct Level {
    int bands = 1;  //!< number of bands in z; see StarBands
    int cells = 2;
    std::vector<int> first;
    std::vector<float> direction[3];  //!< component arrays for kernels
    std::vector<float> illuminance;
    std::vector<int> number;           //!< index of each star in `stars_`
    std::vector<std::uint8_t> colour;  //!< class of color of each star
    float left_out = 0.0F;             //!< illuminance of the brightest star that is not in this level [lx]
  };

  //! For one class of star color: the number of stars that are at least as bright as each of a
  //! series of logarithmically spaced illuminances.
  using ClassCounts = std::vector<int>;

  void count_classes();

  [[nodiscard]] Level level_of(const std::vector<int>& numbers) const;

  ShiftGains gains_;
  //! For each row of ShiftGains, the largest gain of the classes that occur.
  std::vector<float> max_gain_;
  std::vector<FieldStar> stars_;  //!< brightest first
  //! The first level contains all stars; each further level contains fewer.
  std::vector<Level> levels_;
  //! Logarithm of the first illuminance for which `counts_` has an entry.
  float log_dimmest_ = 0.0F;
  std::array<ClassCounts, star_classes> counts_;
};

}  // namespace ergodome
