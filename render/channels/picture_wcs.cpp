#include "render/channels/picture_wcs.h"

#include <cmath>

#include "kernels/core/angles.h"

namespace ergodome {

namespace {

//! Returns the FITS pixel coordinate of a position in the image; `position` runs from -1 to 1
//! across its width or height.
double fits_pixel(double position, int size_px) { return 0.5 * (1.0 + position) * size_px + 0.5; }

//! Returns 1 for a normal image, -1 for a mirrored one.
double to_the_right(const Projection& projection) { return -projection.left; }

PictureWcs pinhole_wcs(const Projection& projection) {
  const Pinhole<double>& screen = projection.pinhole;
  const double right = to_the_right(projection);
  return {"TAN",
          {fits_pixel(-right * screen.middle_x / screen.half_width, projection.width_px),
           fits_pixel(-screen.middle_y / screen.half_height, projection.height_px)},
          {right * 2.0 * radian_deg * screen.half_width / projection.width_px,
           2.0 * radian_deg * screen.half_height / projection.height_px},
          {0.0, 0.0},
          180.0};
}

//! Returns the FITS projection code of a lens and the radius of its unit circle (half the width of
//! the picture) in the plane of projection [deg].
std::pair<const char*, double> lens_wcs(const FisheyeLens<double>& lens) {
  switch (lens.law) {
    case LensLaw::equidistant:
      return {"ARC", radian_deg * lens.half_angle};
    case LensLaw::equisolid:
      return {"ZEA", 2.0 * radian_deg * std::sin(0.5 * lens.half_angle)};
    case LensLaw::stereographic:
      return {"STG", 2.0 * radian_deg * std::tan(0.5 * lens.half_angle)};
    case LensLaw::orthographic:
      return {"SIN", radian_deg * std::sin(lens.half_angle)};
    case LensLaw::polynomial:
      break;
  }
  return {"ZPN", radian_deg};
}

PictureWcs dome_wcs(const Projection& projection) {
  const DomeFisheye<double>& dome = projection.dome;
  const auto [code, radius_deg] = lens_wcs(dome.lens);
  const double step_deg = 2.0 * radius_deg / projection.width_px;
  const double tilt_deg = radian_deg * std::atan2(dome.tilt_sine, dome.tilt_cosine);
  PictureWcs wcs = {code,
                    {fits_pixel(0.0, projection.width_px), fits_pixel(0.0, projection.height_px)},
                    {to_the_right(projection) * step_deg, step_deg},
                    {0.0, 90.0 - tilt_deg},
                    180.0};
  if (dome.lens.law == LensLaw::polynomial) {
    for (int i = 0; i < 4; ++i) {
      wcs.pv2.emplace_back(2 * i + 1, dome.lens.coefficient[i]);
    }
  }
  return wcs;
}

PictureWcs equirectangular_wcs(const Projection& projection) {
  const double azimuth_deg =
      wraps_around(projection) ? 360.0 : 2.0 * radian_deg * projection.equirectangular.half_azimuth;
  return {"CAR",
          {fits_pixel(0.0, projection.width_px), fits_pixel(0.0, projection.height_px)},
          {to_the_right(projection) * azimuth_deg / projection.width_px, 180.0 / projection.height_px},
          {0.0, 0.0}};
}

PictureWcs cylinder_wcs(const Projection& projection) {
  const Cylinder<double>& cylinder = projection.cylinder;
  // PV2_1 = 0 projects from the middle of the sphere, PV2_2 = 1 onto a cylinder of its radius.
  return {"CYP",
          {fits_pixel(0.0, projection.width_px),
           fits_pixel(-cylinder.middle_height / cylinder.half_height, projection.height_px)},
          {to_the_right(projection) * 2.0 * radian_deg * cylinder.half_azimuth / projection.width_px,
           2.0 * radian_deg * cylinder.half_height / projection.height_px},
          {0.0, 0.0},
          std::nullopt,
          {{1, 0.0}, {2, 1.0}}};
}

}  // namespace

std::optional<PictureWcs> picture_wcs(const Projection& projection) {
  switch (projection.kind) {
    case ProjectionKind::pinhole:
      return pinhole_wcs(projection);
    case ProjectionKind::dome_fisheye:
      return projection.dome.off_centre == 0 ? std::optional(dome_wcs(projection)) : std::nullopt;
    case ProjectionKind::equirectangular:
      return equirectangular_wcs(projection);
    case ProjectionKind::cylinder:
      return cylinder_wcs(projection);
    case ProjectionKind::cube:
      break;
  }
  return std::nullopt;
}

}  // namespace ergodome
