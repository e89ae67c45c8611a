#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "kernels/projection/projection.h"
#include "render/eyes/eye_camera.h"

namespace ergodome {

//! The exact view of some pixels of an eye's picture: rays in closed form (Gralla & Lupsasca 2020)
//! and exact derivatives of the sky direction by the view direction. Converts errors of sky
//! directions to displacements on the screen.
class PixelReference {
 public:
  //! `pixels`: pixel indices, row times width plus column. `pixel`: the angle that is the unit of
  //! errors [rad].
  PixelReference(const EyeCamera& eye, const Projection& projection, const std::vector<std::int64_t>& pixels,
                 double pixel);

  [[nodiscard]] std::size_t size() const { return points_.size(); }

  //! Returns whether a pixel is compared: it is entirely inside the picture, farther from the
  //! shadow's edge than its own size, and its reference rays converged and agree on whether it sees
  //! the sky.
  [[nodiscard]] bool counts(std::size_t i) const { return points_[i].counts; }

  //! Returns whether a pixel sees the sky.
  [[nodiscard]] bool is_lit(std::size_t i) const { return points_[i].lit; }

  //! Returns the exact direction on the sky; zero if there is none.
  [[nodiscard]] const Vector3<double>& sky(std::size_t i) const { return points_[i].sky; }

  //! Returns the error of a method at a pixel, in the view's axes [px]: the displacement on the
  //! screen after which the exact lens would show `seen`, δn = J⁻¹ Δsky. Here Δsky is the error of
  //! the sky direction, and J the derivative of the sky direction with respect to the view
  //! direction n.
  //!
  //! `seen` is empty if the method shows no sky. If only one of method and reference sees the sky,
  //! the error is the distance to the shadow's edge, along the view's x. If neither does, it is
  //! zero.
  [[nodiscard]] Vector3<double> miss(std::size_t i, const std::optional<Vector3<double>>& seen) const;

 private:
  struct Point {
    bool counts = false;
    bool lit = false;
    double edge_px = 0.0;  //!< distance of the pixel from the shadow's edge
    Vector3<double> sky{};
    //! Changes of the view direction from pixel to pixel: `view_x` to the right, `view_y` down.
    Vector3<double> view_x{};
    Vector3<double> view_y{};
    Vector3<double> sky_x{};  //!< changes of `sky` from pixel to pixel: `sky_x` to the right, `sky_y` down
    Vector3<double> sky_y{};
  };

  void place_points(const EyeCamera& eye, const Projection& projection, const std::vector<std::int64_t>& pixels);

  double pixel_;
  std::vector<Point> points_;
};

}  // namespace ergodome
