#pragma once

#include <glm/mat3x3.hpp>
#include <vector>

#include "content/stars/star_catalogue.h"
#include "kernels/sky/blackbody.h"
#include "kernels/stars/search/patch_search.h"
#include "render/passes/stars/drawing/shift_gains.h"
#include "render/passes/stars/search/sky_frustum.h"

namespace ergodome {

//! Stars that are bright enough: those whose illuminance, times the bound of what their class gains in a row of ShiftGains, reaches so
//! much [lx]. It is not negative.
struct StarFloor {
  float illuminance;
  int shift_row = ShiftGains::unshifted_row();
};

//! Stars by their place on the sky.
class StarField {
 public:
  //! `sky_from_equatorial`: from equatorial J2000 to the hole's sky axes. `colours`, in host memory, tells how large a star of some brightness
  //! is. A star without a colour is taken for white (B-V = 0.3).
  StarField(const StarCatalogue& catalogue, const glm::dmat3& sky_from_equatorial, const BlackbodyTable& colours);

  [[nodiscard]] const std::vector<FieldStar>& stars() const { return stars_; }

  //! What they gain by shifts.
  [[nodiscard]] const ShiftGains& gains() const { return gains_; }

  //! How many stars are bright enough, or a few more.
  [[nodiscard]] int count_from(const StarFloor& floor) const;

  //! Puts the numbers of the stars of a part of the sky that are bright enough into the first places of `found`, which is made large
  //! enough for all, and returns how many there are. Of stars within 2e-7 rad of the part's sides any may be among them.
  int search(const SkyPart& part, const StarFloor& floor, std::vector<int>& found) const;

  //! As kernels read it: put(vector) says where a copy of it lies for them, or where it is.
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
    field.greatest_gain = put(greatest_gain_);
    return field;
  }

 private:
  //! The brightest stars, by their place on the sky.
  struct Level {
    int bands = 1;  //!< as in StarBands
    int cells = 2;
    std::vector<int> first;
    std::vector<float> direction[3];  //!< as kernels read them
    std::vector<float> illuminance;
    std::vector<int> number;           //!< in `stars_`
    std::vector<std::uint8_t> colour;  //!< class
    float left_out = 0.0F;             //!< illuminance of the brightest that is not among them
  };

  //! How many stars of a class have at least the illuminances whose logarithms go up by equal steps.
  using ClassCounts = std::vector<int>;

  void count_classes();

  [[nodiscard]] Level level_of(const std::vector<int>& numbers) const;
  [[nodiscard]] const Level& level_for(float faintest) const;

  ShiftGains gains_;
  std::vector<float> greatest_gain_;  //!< of the stars that there are, row by row
  std::vector<FieldStar> stars_;      //!< the brightest first
  std::vector<Level> levels_;         //!< all stars, and then fewer and fewer
  float log_dimmest_ = 0.0F;          //!< the first of the steps by which classes are counted
  std::array<ClassCounts, star_classes> counts_;
};

}  // namespace ergodome
