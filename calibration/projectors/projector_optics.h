#pragma once

#include <optional>

#include "calibration/dome/dome_setup.h"
#include "kernels/projection/lens_law.h"

namespace ergodome {

//! A place on a projector's raster: 0 to 1 across it, x to the right, y down.
struct RasterPlace {
  double x;
  double y;
};

//! What light of a projector meets which point of the dome: through its lens, over its mirror if it has one, to the sphere. The shell that
//! stops light from outside is the half of the sphere above the rim. Places are in the dome's axes, as in DomeSetup.
class ProjectorOptics {
 public:
  //! Throws Error, naming the projector, where it has no lens, as a warp alone does not tell where the picture goes, and where it stands
  //! outside the sphere above the dome's rim, where the dome's shell is between it and the dome's inside.
  ProjectorOptics(const DomeSetup& setup, const ProjectorSetup& projector);

  //! The point of the sphere [m] that a place of the raster meets. A fisheye's map goes on beyond its image circle, where no light is,
  //! so that meshes need not end there. Nothing where light misses the mirror, or the sphere.
  [[nodiscard]] std::optional<Vector3<double>> dome_point(const RasterPlace& place) const;

  //! The place of the raster that lights a point of the sphere; the inverse. Nothing where none does.
  [[nodiscard]] std::optional<RasterPlace> raster_place(const Vector3<double>& point) const;

  //! How far a place lies inside of what is lit: 0 at the rims of raster and image circle and beyond, 1 in the middle, smooth between.
  [[nodiscard]] double depth(const RasterPlace& place) const;

  //! Area of the sphere that the raster would light if all of it were lit as this place is [m²]; 0 where there is none.
  [[nodiscard]] double spread_m2(const RasterPlace& place) const;

  //! Whether the projector stands outside the sphere, so that its light comes in below the dome's rim.
  [[nodiscard]] bool outside() const;

  //! How messages call the projector (place_of()).
  [[nodiscard]] const std::string& place() const { return place_; }
  [[nodiscard]] double dome_radius_m() const { return dome_radius_m_; }
  [[nodiscard]] int longer_side_px() const { return longer_side_px_; }

 private:
  [[nodiscard]] Vector3<double> lens_direction(const RasterPlace& place) const;
  [[nodiscard]] std::optional<RasterPlace> lens_place(const Vector3<double>& direction) const;
  [[nodiscard]] double circle_radius(const RasterPlace& place, double& across, double& upwards) const;
  [[nodiscard]] std::optional<Vector3<double>> sphere_point(const Vector3<double>& from,
                                                            const Vector3<double>& way) const;
  [[nodiscard]] bool is_stopped_outside(const Vector3<double>& way) const;
  [[nodiscard]] Vector3<double> mirror_point(const Vector3<double>& point) const;

  std::string place_;
  double dome_radius_m_;
  Vector3<double> zenith_;  //!< direction of the dome's top
  Vector3<double> position_m_;
  ProjectorAxes axes_;
  double aspect_;       //!< of the raster, width over height
  int longer_side_px_;  //!< of the raster
  std::optional<SphericalMirror> mirror_;
  Frustum frustum_;
  std::optional<ProjectorFisheye> fisheye_;
  FisheyeLens<double> law_{};  //!< of the fisheye
};

}  // namespace ergodome
