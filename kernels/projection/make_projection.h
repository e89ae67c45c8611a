#pragma once

#include "kernels/projection/projection.h"

// Makes projections of all kinds.
namespace ergodome {

//! Parameters of a dome on a domemaster.
struct DomeView {
  double field_of_view = 3.14159265358979323846;  //!< full angle [rad], see largest_half_angle()
  double tilt = 0.0;                              //!< tilt of the dome's top to the front [rad]
  LensLaw law = LensLaw::equidistant;
  double coefficient[4] = {0.0, 0.0, 0.0, 0.0};  //!< coefficients of LensLaw::polynomial
  //! Position of the viewer for whom directions in the picture are correct, relative to the dome's
  //! center in view axes (x right, y up, z back), in radii of the dome; shorter than 1.
  Vector3<double> viewer = {0.0, 0.0, 0.0};
  double cut_below = 0.0;  //!< black part of the image's height, from the bottom
  double cut_above = 0.0;  //!< black part of the image's height, from the top
};

//! Sides of a frustum on a screen at distance 1, with left < right and down < up.
struct FrustumSides {
  double left;
  double right;
  double up;
  double down;
};

inline namespace ERGO_TARGET {

namespace detail {
ERGO_HD Projection plain_projection(ProjectionKind kind, int width_px, int height_px) {
  return {kind,
          width_px,
          height_px,
          -1.0,
          {{LensLaw::equidistant, 1.0, 1.0, 1.0, {}}, 0.0, 1.0, {0.0, 0.0, 0.0}, 0, 0, -1.0, 1.0},
          {3.14159265358979323846},
          {CubeLayout::face, CubeFace::front},
          {1.0, 0.0, 1.0},
          {1.0, 1.0, 0.0, 0.0}};
}
}  // namespace detail

ERGO_HD Projection make_dome_projection(int size_px, const DomeView& view) {
  Projection p = detail::plain_projection(ProjectionKind::dome_fisheye, size_px, size_px);
  p.dome.lens = make_fisheye_lens(view.law, view.field_of_view, view.coefficient);
  p.dome.tilt_sine = ::sin(view.tilt);
  p.dome.tilt_cosine = ::cos(view.tilt);
  p.dome.viewer = view.viewer;
  p.dome.off_centre = dot(view.viewer, view.viewer) > 0.0 ? 1 : 0;
  p.dome.truncated = view.cut_below > 0.0 || view.cut_above > 0.0 ? 1 : 0;
  // Where nothing is cut, the limit is outside the square.
  p.dome.lowest = view.cut_below > 0.0 ? 2.0 * view.cut_below - 1.0 : -2.0;
  p.dome.highest = view.cut_above > 0.0 ? 1.0 - 2.0 * view.cut_above : 2.0;
  return p;
}

//! Makes an equidistant domemaster of the given full field of view, with the top tilted to the
//! front by `tilt` [rad].
ERGO_HD Projection make_dome_projection(int size_px, double field_of_view, double tilt) {
  DomeView view;
  view.field_of_view = field_of_view;
  view.tilt = tilt;
  return make_dome_projection(size_px, view);
}

//! Makes a picture of all elevations and of the given full azimuth [rad], up to 2π.
ERGO_HD Projection make_equirectangular_projection(int width_px, int height_px,
                                                   double azimuth = 6.28318530717958647692) {
  Projection p = detail::plain_projection(ProjectionKind::equirectangular, width_px, height_px);
  p.equirectangular.half_azimuth = 0.5 * azimuth;
  return p;
}

//! Makes a picture of all faces of a cube, each `face_px` wide.
ERGO_HD Projection make_cube_projection(int face_px, CubeLayout layout) {
  Projection p =
      detail::plain_projection(ProjectionKind::cube, cube_columns(layout) * face_px, cube_rows(layout) * face_px);
  p.cube.layout = layout;
  return p;
}

//! Makes a picture of one face of a cube.
ERGO_HD Projection make_cube_face_projection(int face_px, CubeFace face) {
  Projection p = make_cube_projection(face_px, CubeLayout::face);
  p.cube.face = face;
  return p;
}

//! Makes a cylinder of the given full azimuth [rad], up to 2π, between the tangents of two
//! elevations.
ERGO_HD Projection make_cylinder_projection(int width_px, int height_px, double azimuth, double lowest,
                                            double highest) {
  Projection p = detail::plain_projection(ProjectionKind::cylinder, width_px, height_px);
  p.cylinder = {0.5 * azimuth, 0.5 * (highest + lowest), 0.5 * (highest - lowest)};
  return p;
}

//! Makes a flat screen of the given horizontal field of view [rad], below π, with square pixels.
ERGO_HD Projection make_pinhole_projection(int width_px, int height_px, double field_of_view) {
  const double half_width = ::tan(0.5 * field_of_view);
  Projection p = detail::plain_projection(ProjectionKind::pinhole, width_px, height_px);
  p.pinhole = {half_width, half_width * height_px / width_px, 0.0, 0.0};
  return p;
}

//! Makes a flat screen whose center need not be on the view's axis.
ERGO_HD Projection make_frustum_projection(int width_px, int height_px, const FrustumSides& sides) {
  Projection p = detail::plain_projection(ProjectionKind::pinhole, width_px, height_px);
  p.pinhole = {0.5 * (sides.right - sides.left), 0.5 * (sides.up - sides.down), 0.5 * (sides.right + sides.left),
               0.5 * (sides.up + sides.down)};
  return p;
}

//! Returns a projection whose picture is mirrored, as if seen from outside the dome.
ERGO_HD Projection seen_from_outside(Projection projection) {
  projection.left = -projection.left;
  return projection;
}

}  // namespace ERGO_TARGET
}  // namespace ergodome
