#pragma once

#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>
#include <vector>

#include "kernels/core/angles.h"
#include "kernels/projection/make_projection.h"

// Projections of every kind for tests, and positions in their pictures.
namespace ergodome::test {

struct NamedProjection {
  std::string name;
  Projection projection;
};

inline std::ostream& operator<<(std::ostream& to, const NamedProjection& named) { return to << named.name; }

inline Projection lens_of(LensLaw law, double field_of_view_deg, int size_px = 1000) {
  DomeView view;
  view.law = law;
  view.field_of_view = field_of_view_deg * pi / 180.0;
  view.tilt = 0.3;
  return make_dome_projection(size_px, view);
}

//! Returns a fisheye lens as measured in a dome: nearly equidistant, slightly compressed towards
//! its rim. At 90°, its radius is about that of the image circle.
inline DomeView measured_lens() {
  DomeView view;
  view.law = LensLaw::polynomial;
  const double coefficient[4] = {0.67, -0.011, -0.0035, 0.0004};
  std::copy(coefficient, coefficient + 4, view.coefficient);
  return view;
}

inline Projection off_centre_dome(int size_px = 1000) {
  DomeView view;
  view.field_of_view = 1.1 * pi;
  view.tilt = 0.4;
  view.viewer = {0.3, -0.2, 0.5};
  return make_dome_projection(size_px, view);
}

inline std::vector<NamedProjection> every_projection() {
  DomeView cut;
  cut.cut_below = 0.2;
  cut.cut_above = 0.1;
  return {{"Equidistant", lens_of(LensLaw::equidistant, 180.0)},
          {"EquidistantSphere", lens_of(LensLaw::equidistant, 360.0)},
          {"Equisolid", lens_of(LensLaw::equisolid, 180.0)},
          {"EquisolidSphere", lens_of(LensLaw::equisolid, 360.0)},
          {"Stereographic", lens_of(LensLaw::stereographic, 180.0)},
          {"StereographicWide", lens_of(LensLaw::stereographic, 320.0)},
          {"Orthographic", lens_of(LensLaw::orthographic, 120.0)},
          {"OrthographicHemisphere", lens_of(LensLaw::orthographic, 180.0)},
          {"Polynomial", make_dome_projection(1000, measured_lens())},
          {"OffCentre", off_centre_dome()},
          {"Truncated", make_dome_projection(1000, cut)},
          {"FromOutside", seen_from_outside(lens_of(LensLaw::equidistant, 200.0))},
          {"Equirectangular", make_equirectangular_projection(1000, 500)},
          {"EquirectangularPart", make_equirectangular_projection(600, 500, 1.2 * pi)},
          {"CubeCross", make_cube_projection(250, CubeLayout::cross)},
          {"CubeStrip", make_cube_projection(160, CubeLayout::strip)},
          {"CubeFace", make_cube_face_projection(500, CubeFace::back)},
          {"CubeFromOutside", seen_from_outside(make_cube_projection(250, CubeLayout::cross))},
          {"Cylinder", make_cylinder_projection(1000, 318, 2.0 * pi, -1.0, 1.0)},
          {"CylinderPart", make_cylinder_projection(1000, 400, 3.0, -0.2, 1.5)},
          {"Pinhole", make_pinhole_projection(800, 600, 1.3)},
          {"Frustum", make_frustum_projection(900, 400, {-0.4, 1.3, 0.9, -0.1})}};
}

struct ImagePosition {
  double x_px;
  double y_px;
};

//! Returns whether a position itself is inside the projection's image. This may differ from the
//! pixel that contains the position.
inline bool is_in_image(const Projection& p, const ImagePosition& position) {
  if (p.kind == ProjectionKind::dome_fisheye) {
    return image_coverage(p, position.x_px, position.y_px) >= 0.5;
  }
  return position.x_px >= 0.0 && position.y_px >= 0.0 && position.x_px <= p.width_px && position.y_px <= p.height_px &&
         image_coverage(p, position.x_px, position.y_px) > 0.0;
}

//! Returns positions in a picture: a lattice, the middle, and positions that are `inside` pixels
//! away from the corners, the sides and, for a fisheye, the rim. Omits positions outside the
//! projection's image.
inline std::vector<ImagePosition> image_positions(const Projection& p, double inside) {
  const double right = p.width_px - inside;
  const double bottom = p.height_px - inside;
  // The middle of a cube picture would be exactly on the edge between two faces, so the position is
  // shifted.
  const double x = 0.5 * p.width_px + (p.kind == ProjectionKind::cube ? 0.7 : 0.0);
  const double y = 0.5 * p.height_px;
  std::vector<ImagePosition> found = {{x, y},           {inside, inside},  {right, inside},
                                      {inside, bottom}, {right, bottom},   {inside, y + 0.3},
                                      {right, y + 0.3}, {x + 0.3, inside}, {x + 0.3, bottom}};
  for (int i = 0; i < 400; ++i) {
    const int row = i / 20;
    found.push_back({p.width_px * (0.013 + 0.05 * (i % 20)), p.height_px * (0.017 + 0.05 * row)});
  }
  if (p.kind == ProjectionKind::dome_fisheye) {
    const double rim = p.dome.lens.rim * x - inside;
    for (int i = 0; i < 16; ++i) {
      found.push_back({x + rim * std::cos(0.3927 * i), y + rim * std::sin(0.3927 * i)});
    }
  }
  std::erase_if(found, [&](const ImagePosition& position) { return !is_in_image(p, position); });
  return found;
}

}  // namespace ergodome::test
