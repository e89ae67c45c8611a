#pragma once

#include <cmath>
#include <vector>

#include "kernels/launch/launch.h"
#include "kernels/spacetime/shadow/critical_curve.h"
#include "tests/render/passes/stars/star_cameras.h"

// A slow reference search for the lensed images of stars. It uses a mesh of traced rays.
namespace ergodome::test {

//! A star image that the reference search has found.
struct FoundImage {
  double magnification;
  double from_edge;  //!< angle from the shadow's edge [rad]
};

//! Computes distances from the edge of a camera's shadow. The chart is in the frame of the
//! observer, unlike that of grids.
class ShadowDistance {
 public:
  explicit ShadowDistance(const CameraStation& camera) : camera_(camera), chart_(make_shadow_chart(camera)) {}

  [[nodiscard]] const ShadowChart& chart() const { return chart_; }
  [[nodiscard]] double edge(double gamma) const { return edge_polar_angle(camera_, chart_, gamma); }

  //! Returns the angle of a direction from the shadow's edge [rad].
  [[nodiscard]] double of(const Vector3<double>& n) const {
    const double first = dot(n, chart_.first);
    const double second = dot(n, chart_.second);
    return std::atan2(std::hypot(first, second), dot(n, chart_.centre)) - edge(std::atan2(second, first));
  }

 private:
  CameraStation camera_;
  ShadowChart chart_;
};

//! A mesh of triangles over the camera's sky outside the shadow, with the traced sky directions at
//! its vertices. It starts at a minimum distance from the edge of the shadow.
class RayMesh {
 public:
  RayMesh(const EyeCamera& eye, double min_distance, int columns, int rows) : columns_(columns), rows_(rows) {
    const CameraStation camera = camera_of(eye);
    const ShadowDistance shadow(camera);
    const ShadowChart& chart = shadow.chart();
    std::vector<double> values[6];
    for (int column = 0; column < columns; ++column) {
      const double gamma = 2.0 * pi * column / columns;
      const double edge = shadow.edge(gamma);
      for (int row = 0; row <= rows; ++row) {
        const double from_edge =
            (pi - edge) * std::pow(min_distance / (pi - edge), 1.0 - static_cast<double>(row) / rows);
        const double alpha = edge + from_edge;
        const Vector3<double> n = std::cos(alpha) * chart.centre + (std::sin(alpha) * std::cos(gamma)) * chart.first +
                                  (std::sin(alpha) * std::sin(gamma)) * chart.second;
        const double parts[3] = {n.x, n.y, n.z};
        for (int i = 0; i < 3; ++i) {
          values[i].push_back(parts[i]);
        }
        from_edge_.push_back(from_edge);
      }
    }
    trace(camera, values);
  }

  //! Returns the images of a star: one for each triangle whose sky directions surround it.
  [[nodiscard]] std::vector<FoundImage> images(const Vector3<double>& star) const {
    std::vector<FoundImage> found;
    for (int column = 0; column < columns_; ++column) {
      for (int row = 0; row < rows_; ++row) {
        const std::size_t a = index(column, row);
        const std::size_t b = index(column + 1, row);
        const std::size_t c = index(column, row + 1);
        const std::size_t d = index(column + 1, row + 1);
        add(a, b, c, star, found);
        add(d, c, b, star, found);
      }
    }
    return found;
  }

 private:
  void trace(const CameraStation& camera, std::vector<double> (&values)[6]) {
    for (int i = 3; i < 6; ++i) {
      values[i].resize(values[0].size());
    }
    RayBatch<double> batch{};
    batch.camera = camera;
    batch.settings = {1e-9, 400, true};
    batch.method = TraceMethod::taylor;
    batch.count = static_cast<int>(values[0].size());
    for (int i = 0; i < 3; ++i) {
      batch.direction[i] = values[i].data();
      batch.sky[i] = values[3 + i].data();
    }
    launch(Backend::cpu, batch);
    for (std::size_t i = 0; i < values[0].size(); ++i) {
      camera_.push_back({values[0][i], values[1][i], values[2][i]});
      sky_.push_back({values[3][i], values[4][i], values[5][i]});
    }
  }

  [[nodiscard]] std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(column % columns_) * static_cast<std::size_t>(rows_ + 1) +
           static_cast<std::size_t>(row);
  }

  void add(std::size_t a, std::size_t b, std::size_t c, const Vector3<double>& star,
           std::vector<FoundImage>& found) const {
    if (dot(sky_[a], star) < 0.0) {
      return;
    }
    const double first = dot(star, cross(sky_[a], sky_[b]));
    const double second = dot(star, cross(sky_[b], sky_[c]));
    const double third = dot(star, cross(sky_[c], sky_[a]));
    const bool inside = (first > 0.0 && second > 0.0 && third > 0.0) || (first < 0.0 && second < 0.0 && third < 0.0);
    if (inside) {
      const auto area = [](const Vector3<double>& p, const Vector3<double>& q, const Vector3<double>& r) {
        const Vector3<double> normal = cross(q - p, r - p);
        return std::sqrt(dot(normal, normal));
      };
      found.push_back({area(camera_[a], camera_[b], camera_[c]) / area(sky_[a], sky_[b], sky_[c]), from_edge_[a]});
    }
  }

  int columns_;
  int rows_;
  std::vector<double> from_edge_;
  std::vector<Vector3<double>> camera_;
  std::vector<Vector3<double>> sky_;
};

}  // namespace ergodome::test
