#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "kernels/projection/projection.h"
#include "render/eyes/eye_camera.h"

namespace ergodome {

//! The exact view of some pixels of an eye's picture: rays in closed form (Gralla & Lupsasca 2020)
//! and exact derivatives of the lens. Converts errors of sky directions to displacements on the
//! screen.
class PixelReference {
 public:
  //! `pixels`: row times width plus column. `pixel`: the angle that is the unit of errors [rad].
  PixelReference(const EyeCamera& eye, const Projection& projection, const std::vector<std::int64_t>& pixels,
                 double pixel);

  [[nodiscard]] std::size_t size() const { return points_.size(); }

  //! Returns whether a pixel is compared: it is entirely in the picture, and more than its size
  //! from the shadow's edge.
  [[nodiscard]] bool counts(std::size_t i) const { return points_[i].counts; }

  //! Returns whether a pixel sees the sky.
  [[nodiscard]] bool is_lit(std::size_t i) const { return points_[i].lit; }

  //! Returns the exact direction on the sky; zero if there is none.
  [[nodiscard]] const Vector3<double>& sky(std::size_t i) const { return points_[i].sky; }

  //! Returns the displacement on the screen, in the view's axes [px], that turns the exact sky into
  //! `seen`: δn = J⁻¹ Δsky.
  //!
  //! `seen` is empty if a method shows no sky. The error is then the distance to the shadow's edge,
  //! and so is that of a sky inside the shadow; both displacements point along the view's x. It is
  //! zero if neither sees the sky.
  [[nodiscard]] Vector3<double> miss(std::size_t i, const std::optional<Vector3<double>>& seen) const;

 private:
  struct Point {
    bool counts = false;
    bool lit = false;
    double edge_px = 0.0;  //!< distance from the shadow's edge
    Vector3<double> sky{};
    //! Derivatives of the view's direction per pixel to the right and down.
    Vector3<double> view_x{};
    Vector3<double> view_y{};
    Vector3<double> sky_x{};  //!< the same for the sky's direction
    Vector3<double> sky_y{};
  };

  void place_points(const EyeCamera& eye, const Projection& projection, const std::vector<std::int64_t>& pixels);

  double pixel_;
  std::vector<Point> points_;
};

}  // namespace ergodome
