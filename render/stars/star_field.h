#pragma once

#include <array>
#include <glm/mat3x3.hpp>
#include <vector>

#include "content/stars/star_catalogue.h"
#include "kernels/sky/blackbody.h"

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
  double sine;           //!< of the cone's half angle, and its cosine
  double cosine;
  int first;  //!< range of the stars inside, the brightest first
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

  //! The greatest illuminance of a star [lx]; 0 without stars.
  [[nodiscard]] float brightest() const;

  //! Calls visit(star number) for the stars of all finest cells that a cone touches, and that may hold one of at least `faintest` lx;
  //! in each cell the brightest first, until `visit` returns false. `sine`, `cosine`: of the cone's half angle, below a quarter turn.
  template <class Visit>
  void search(const Vector3<double>& axis, double sine, double cosine, float faintest, const Visit& visit) const {
    for (int face = 0; face < 6; ++face) {
      search_cell(0, face, axis, sine, cosine, faintest, visit);
    }
  }

 private:
  template <class Visit>
  void search_cell(int level, int index, const Vector3<double>& axis, double sine, double cosine, float faintest,
                   const Visit& visit) const {
    const SkyCell& cell = levels_[static_cast<std::size_t>(level)][static_cast<std::size_t>(index)];
    // Cones touch when the angle between their axes is at most the sum of their half angles.
    if (!(cell.brightest >= faintest) || cell.brightest <= 0.0F ||
        dot(cell.axis, axis) < cell.cosine * cosine - cell.sine * sine) {
      return;
    }
    if (level + 1 < static_cast<int>(levels_.size())) {
      for (int child = 0; child < 4; ++child) {
        search_cell(level + 1, 4 * index + child, axis, sine, cosine, faintest, visit);
      }
      return;
    }
    for (int star = cell.first; star < cell.last && visit(star); ++star) {
    }
  }

  void make_cells(int depth);

  std::vector<FieldStar> stars_;              //!< by finest cell, in each the brightest first
  std::vector<std::vector<SkyCell>> levels_;  //!< 6 · 4^level cells a level
};

}  // namespace ergodome
