#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "kernels/projection/projection.h"
#include "render/eyes/eye_camera.h"

namespace ergodome {

//! What some pixels of an eye's picture see, exactly: rays in closed form (Gralla & Lupsasca 2020), and the exact derivatives of the lens
//! there. It tells what a wrong direction of the sky is worth on the screen.
class PixelReference {
 public:
  //! `pixels`: row times width plus column. `pixel`: the angle that errors are counted in [rad].
  PixelReference(const EyeCamera& eye, const Projection& projection, const std::vector<std::int64_t>& pixels,
                 double pixel);

  [[nodiscard]] std::size_t size() const { return points_.size(); }

  //! Whether a pixel is compared: it lies wholly in the picture, and more than a pixel's side from the shadow's edge.
  [[nodiscard]] bool counts(std::size_t i) const { return points_[i].counts; }

  //! Whether it sees the sky.
  [[nodiscard]] bool is_lit(std::size_t i) const { return points_[i].lit; }

  //! The exact direction on the sky; zero where there is none.
  [[nodiscard]] const Vector3<double>& sky(std::size_t i) const { return points_[i].sky; }

  //! Displacement on the screen, in the view's axes [px], that turns the exact sky into `seen`: δn = J⁻¹ Δsky.
  //!
  //! `seen` is nothing where a method shows no sky. That is as wrong as the shadow's edge is far, and so is a sky inside the shadow; the
  //! displacement then points along the view's x. Where neither sees anything it is zero.
  [[nodiscard]] Vector3<double> miss(std::size_t i, const std::optional<Vector3<double>>& seen) const;

 private:
  struct Point {
    bool counts = false;
    bool lit = false;
    double edge_px = 0.0;  //!< distance from the shadow's edge
    Vector3<double> sky{};
    Vector3<double> view_x{};  //!< derivatives of the view's direction per pixel to the right and down
    Vector3<double> view_y{};
    Vector3<double> sky_x{};  //!< the same of the sky's direction
    Vector3<double> sky_y{};
  };

  void place_points(const EyeCamera& eye, const Projection& projection, const std::vector<std::int64_t>& pixels);

  double pixel_;
  std::vector<Point> points_;
};

}  // namespace ergodome
