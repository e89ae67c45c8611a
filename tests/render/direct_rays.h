#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "tests/render/omni_eyes.h"

// A reference for omnidirectional stereo. Each direction of a picture has its own camera, at the
// position that the model defines for it; here each camera traces a single ray.
namespace ergodome::test {

//! A position in a picture.
struct StarSpot {
  double x_px;
  double y_px;
};

//! The picture of an omnidirectional stereo eye, computed by a separate camera and a single ray for
//! each direction.
class DirectRays {
 public:
  DirectRays(const EyeAtOffset& eye_at, double offset, double convergence, const Projection& projection)
      : eye_at_(eye_at), offset_(offset), convergence_(convergence), projection_(projection) {}

  [[nodiscard]] DirectRay ray(const StarSpot& spot) const {
    return direct_ray(eye_at_, direction_from_pixel(projection_, spot.x_px, spot.y_px), offset_, convergence_);
  }

  //! Returns the sky direction at a position of the picture; nothing in the shadow.
  [[nodiscard]] std::optional<Vector3<double>> sky(const StarSpot& spot) const {
    const DirectRay own = ray(spot);
    return direction_is_bright(own.camera, own.n) ? std::optional(exact_sky(own.camera, own.n)) : std::nullopt;
  }

  //! The linear approximation of the map from the picture to the sky at a position: sky direction,
  //! and its changes per pixel.
  struct Map {
    Vector3<double> sky;
    Vector3<double> along_x;
    Vector3<double> along_y;

    [[nodiscard]] double determinant() const {
      const Vector3<double> normal = cross(along_x, along_y);
      return std::sqrt(dot(normal, normal));
    }
  };

  [[nodiscard]] std::optional<Map> map(const StarSpot& spot) const {
    constexpr double h = 1e-3;
    const auto middle = sky(spot);
    const auto right = sky({spot.x_px + h, spot.y_px});
    const auto left = sky({spot.x_px - h, spot.y_px});
    const auto below = sky({spot.x_px, spot.y_px + h});
    const auto above = sky({spot.x_px, spot.y_px - h});
    if (!middle || !right || !left || !below || !above) {
      return std::nullopt;
    }
    return Map{*middle, (0.5 / h) * (*right - *left), (0.5 / h) * (*below - *above)};
  }

  //! Returns the step in the picture [px] that leads to a star according to the linear map.
  static StarSpot way_to(const Map& map, const Vector3<double>& star) {
    const Vector3<double> missing = star - map.sky;
    const double a = dot(map.along_x, map.along_x);
    const double b = dot(map.along_x, map.along_y);
    const double c = dot(map.along_y, map.along_y);
    const double p = dot(map.along_x, missing);
    const double q = dot(map.along_y, missing);
    const double square = std::max(map.determinant() * map.determinant(), 1e-300);
    return {(c * p - b * q) / square, (a * q - b * p) / square};
  }

  //! Finds a star's lensed image by Newton's method, which starts at `spot`. Returns nothing if the
  //! method does not converge.
  [[nodiscard]] std::optional<StarSpot> image(StarSpot spot, const Vector3<double>& star) const {
    for (int round = 0; round < 12; ++round) {
      const auto here = map(spot);
      if (!here) {
        return std::nullopt;
      }
      const StarSpot way = way_to(*here, star);
      const double length = std::hypot(way.x_px, way.y_px);
      const double part = std::min(1.0, 1.0 / length);
      spot = {spot.x_px + part * way.x_px, spot.y_px + part * way.y_px};
      if (length < 1e-4) {
        return spot;
      }
    }
    return std::nullopt;
  }

 private:
  const EyeAtOffset& eye_at_;
  double offset_;
  double convergence_;
  const Projection& projection_;
};

//! Returns the smallest change of the sky direction for a step of one pixel in any direction of the
//! picture [rad]: the smaller singular value of the map.
inline double min_move_of(const DirectRays::Map& map) {
  const double sum = dot(map.along_x, map.along_x) + dot(map.along_y, map.along_y);
  const double d = map.determinant();
  return d / std::sqrt(0.5 * (sum + std::sqrt(std::max(sum * sum - 4.0 * d * d, 0.0))));
}

//! The sky directions at all corners of pixels; each pixel consists of two triangles.
class PixelMesh {
 public:
  PixelMesh(const DirectRays& rays, const Projection& projection)
      : width_(projection.width_px), height_(projection.height_px) {
    for (int y = 0; y <= height_; ++y) {
      for (int x = 0; x <= width_; ++x) {
        corners_.push_back(rays.sky({static_cast<double>(x), static_cast<double>(y)}));
      }
    }
  }

  //! Returns the centers of the pixels in which one of both triangles contains a star.
  [[nodiscard]] std::vector<StarSpot> pixels_with(const Vector3<double>& star) const {
    std::vector<StarSpot> found;
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        if (holds(x, y, {0, 1, 2}, star) || holds(x, y, {3, 2, 1}, star)) {
          found.push_back({x + 0.5, y + 0.5});
        }
      }
    }
    return found;
  }

 private:
  [[nodiscard]] bool holds(int x, int y, const std::array<int, 3>& half, const Vector3<double>& star) const {
    Vector3<double> sky[3];
    for (std::size_t i = 0; i < 3; ++i) {
      const int row = y + half[i] / 2;
      const int column = x + half[i] % 2;
      const auto& corner = corners_[static_cast<std::size_t>(row) * (static_cast<std::size_t>(width_) + 1) +
                                    static_cast<std::size_t>(column)];
      // For triangles that extend over more than half a radian of the sky, it is unclear what is
      // inside.
      if (!corner || dot(*corner, star) < 0.88) {
        return false;
      }
      sky[i] = *corner;
    }
    const double first = dot(star, cross(sky[0], sky[1]));
    const double second = dot(star, cross(sky[1], sky[2]));
    const double third = dot(star, cross(sky[2], sky[0]));
    return (first > 0.0 && second > 0.0 && third > 0.0) || (first < 0.0 && second < 0.0 && third < 0.0);
  }

  int width_;
  int height_;
  std::vector<std::optional<Vector3<double>>> corners_;
};

}  // namespace ergodome::test
