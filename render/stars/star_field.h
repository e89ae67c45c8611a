#pragma once

#include <array>
#include <glm/mat3x3.hpp>
#include <vector>

#include "content/stars/star_catalogue.h"
#include "kernels/sky/blackbody.h"
#include "render/stars/sky_frustum.h"

namespace ergodome {

//! A star as it is drawn.
struct FieldStar {
  Vector3<double> direction;  //!< unit vector in the hole's sky axes (z: spin axis)
  float log_temperature;      //!< ln of its temperature [K]
  float illuminance;          //!< in empty space [lx]
  float radius;               //!< angle that its disk spans, half [rad]
  std::uint32_t number;       //!< as the catalogue counts
};

//! A patch of the sky for searching: a quadrangle of a cube's face, at some depth of halving.
struct SkyCell {
  Vector3<double> axis;  //!< a cone about this holds the cell
  double sine;           //!< of the cone's half angle
  int first;             //!< range of the stars inside, the brightest first
  int last;
  float brightest;  //!< greatest illuminance inside [lx]; 0 without stars
};

//! Stars by their place on the sky.
class StarField {
 public:
  //! `sky_from_map`: from equatorial J2000 to the hole's sky axes. `colours`, in host memory, tells how large a star of some brightness
  //! is. A star without a colour is taken for white (B-V = 0.3).
  StarField(const StarCatalogue& catalogue, const glm::dmat3& sky_from_map, const BlackbodyTable& colours);

  [[nodiscard]] const std::vector<FieldStar>& stars() const { return stars_; }

  //! How many stars have at least `illuminance` lx.
  [[nodiscard]] std::size_t count_from(float illuminance) const;

  //! Calls visit(star number) for the stars of at least `faintest` lx in a part of the sky.
  template <class Visit>
  void search(const SkyFrustum& part, float faintest, const Visit& visit) const {
    for (int face = 0; face < 6; ++face) {
      search_cell(0, face, part, faintest, visit);
    }
  }

 private:
  template <class Visit>
  void search_cell(int level, int index, const SkyFrustum& part, float faintest, const Visit& visit) const {
    const SkyCell& cell = levels_[static_cast<std::size_t>(level)][static_cast<std::size_t>(index)];
    if (!(cell.brightest >= faintest) || cell.brightest <= 0.0F || !may_touch(part, cell.axis, cell.sine)) {
      return;
    }
    if (level + 1 < static_cast<int>(levels_.size())) {
      for (int child = 0; child < 4; ++child) {
        search_cell(level + 1, 4 * index + child, part, faintest, visit);
      }
      return;
    }
    for (int number = cell.first; number < cell.last; ++number) {
      const FieldStar& star = stars_[static_cast<std::size_t>(number)];
      if (!(star.illuminance >= faintest)) {
        return;
      }
      if (holds(part, star.direction)) {
        visit(number);
      }
    }
  }

  void make_cells(int depth);

  std::vector<float> illuminances_;           //!< the greatest first
  std::vector<FieldStar> stars_;              //!< by finest cell, in each the brightest first
  std::vector<std::vector<SkyCell>> levels_;  //!< 6 · 4^level cells a level
};

}  // namespace ergodome
