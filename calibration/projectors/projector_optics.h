#pragma once

#include <optional>

#include "calibration/dome/dome_setup.h"
#include "kernels/projection/lens_law.h"

namespace ergodome {

//! A position on a projector's raster: 0 to 1 across it, x to the right, y down.
struct RasterPosition {
  double x;
  double y;
};

//! The light paths of a projector: through its lens, over its mirror if it has one, to the dome's
//! sphere. The shell, which blocks light from outside, is the half of the sphere above the rim.
//! Positions are in the dome's axes, as in DomeSetup.
class ProjectorOptics {
 public:
  //! Throws Error, which names the projector, if it has no lens, because a warp alone does not
  //! define the light's direction, or if it is outside the sphere above the dome's rim, where the
  //! shell blocks its light.
  ProjectorOptics(const DomeSetup& setup, const ProjectorSetup& projector);

  //! Returns the point of the sphere that a position of the raster lights [m]; nothing if the light
  //! misses the mirror or the sphere, or is blocked by the shell. A fisheye's mapping continues
  //! beyond its image circle, where no light falls, so that meshes need not end there.
  [[nodiscard]] std::optional<Vector3<double>> dome_point(const RasterPosition& location) const;

  //! Returns the position of the raster that lights a point of the sphere: the inverse of
  //! dome_point(). Nothing if none does.
  [[nodiscard]] std::optional<RasterPosition> raster_position(const Vector3<double>& point) const;

  //! Returns how far a position is inside the lit area: 0 at the edges of raster and image circle
  //! and beyond, 1 in the middle, smooth between.
  [[nodiscard]] double depth(const RasterPosition& location) const;

  //! Returns the area of the sphere that the raster would light if its scale at this position
  //! applied to the whole raster [m²]; 0 if the position lights no point.
  [[nodiscard]] double spread_m2(const RasterPosition& location) const;

  //! Returns true if the projector is outside the sphere, so that its light enters below the dome's
  //! rim.
  [[nodiscard]] bool outside() const;

  //! Returns the name of the projector for messages (location_of()).
  [[nodiscard]] const std::string& location() const { return location_; }
  [[nodiscard]] double dome_radius_m() const { return dome_radius_m_; }
  [[nodiscard]] int longer_side_px() const { return longer_side_px_; }

 private:
  [[nodiscard]] Vector3<double> lens_direction(const RasterPosition& location) const;
  [[nodiscard]] std::optional<RasterPosition> lens_position(const Vector3<double>& direction) const;
  [[nodiscard]] double circle_radius(const RasterPosition& location, double& across, double& upwards) const;
  [[nodiscard]] std::optional<Vector3<double>> sphere_point(const Vector3<double>& from,
                                                            const Vector3<double>& way) const;
  [[nodiscard]] bool is_stopped_outside(const Vector3<double>& way) const;
  [[nodiscard]] Vector3<double> mirror_point(const Vector3<double>& point) const;

  std::string location_;
  double dome_radius_m_;
  Vector3<double> zenith_;  //!< direction of the dome's top
  Vector3<double> position_m_;
  ProjectorAxes axes_;
  double aspect_;       //!< aspect ratio of the raster, width over height
  int longer_side_px_;  //!< longer side of the raster
  std::optional<SphericalMirror> mirror_;
  Frustum frustum_;
  std::optional<ProjectorFisheye> fisheye_;
  FisheyeLens<double> law_{};  //!< relation between angle and radius of the fisheye lens
};

}  // namespace ergodome
