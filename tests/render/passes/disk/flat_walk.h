#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "content/show/reading/show_reader.h"
#include "kernels/core/angles.h"
#include "kernels/core/find_root.h"
#include "kernels/disk/crossing_layers.h"
#include "kernels/disk/disk_light.h"
#include "kernels/near_rays/near_pixels.h"
#include "kernels/objects/path_step.h"
#include "kernels/projection/make_projection.h"
#include "kernels/sky/blackbody.h"
#include "kernels/spacetime/geodesic/affine_distance.h"
#include "render/frame/show_renderer.h"
#include "render/lens/direct_lens.h"
#include "render/passes/disk/disk_camera.h"
#include "render/passes/disk/disk_pass.h"
#include "tests/support/sanitized.h"

// Shows for tests with eyes of the stereo model `flat`, and what these eyes see. The latter is
// computed by following their lines of sight.
namespace ergodome::test {

inline constexpr int flat_px = sanitized ? 120 : 300;

inline Show flat_show(const std::string& scene, const std::string& camera, double baseline,
                      const std::string& view = "projection = \"pinhole\"\nfov_deg = 60\naspect = 1.5\n",
                      int size_px = flat_px) {
  return parse_show("[camera]\n" + camera + "[sky]\nmap = \"black\"\n" + scene + "[view]\nsize_px = " +
                        std::to_string(size_px) + "\n" + view + "[stereo]\nmodel = \"flat\"\nlayout = \"separate\"\n" +
                        "baseline = " + std::to_string(baseline) + "\n",
                    "flat.toml");
}

inline const std::string plain_disk = "[disk]\nouter = 16\nexposure = 1\n";

inline std::vector<Picture> eyes_of(const Show& show, LensChoice lens) {
  ShowRenderer renderer(show, Backend::cpu, lens);
  return renderer.render_window_parts(camera_pose(show, 0.0), make_projection(show.view, show.view.size_px, 0.0),
                                      ViewMode::sky);
}

inline Vector3<float> light_at(const Picture& picture, int x, int y) {
  const float* const at =
      picture.rgba.data() +
      4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) + static_cast<std::size_t>(x));
  return {at[0], at[1], at[2]};
}

//! Follows an eye's line of sight in small steps through the flat tangent space of the head, in
//! double precision. Finds the first object on it.
class FlatWalk {
 public:
  FlatWalk(const Show& show, double offset)
      : show_(show),
        head_(eye_camera(show, camera_pose(show, 0.0), 0.0)),
        camera_(station_of(head_)),
        projection_(make_projection(show.view, show.view.size_px, 0.0)) {
    const double(&m)[3][3] = head_.frame_from_view;
    eye_ = {offset * m[0][0], offset * m[1][0], offset * m[2][0]};
    if (show.disk) {
      disk_.emplace(show, Backend::cpu);
      look_ = disk_->look_at(0.0);
      limits_ =
          layer_limits(spacetime_of(show), static_cast<double>(look_.inner_r), static_cast<double>(look_.outer_r));
      limits_.tolerance = 1e-9;
    }
  }

  enum class Met { nothing, horizon, disk, shell, object };
  struct Seen {
    Met met;
    //! Radius at which the line of sight meets the disk [M].
    double r;
  };

  //! Returns what an eye sees at a position of the picture [px].
  [[nodiscard]] Seen seen_at(double x, double y) const {
    const Vector3<double> view = direction_from_pixel(projection_, x, y);
    const double(&f)[3][3] = head_.frame_from_view;
    const auto row = [&](int i) { return f[i][0] * view.x + f[i][1] * view.y + f[i][2] * view.z; };
    const Vector3<double> m = {row(0), row(1), row(2)};
    LinePoint before = line_point_at(m, nearest * head_.r);
    for (double s = nearest * step * head_.r; s < farthest * head_.r; s *= step_at(s)) {
      const LinePoint now = line_point_at(m, s);
      Seen seen = between(m, before, now);
      if (seen.met != Met::nothing) {
        return seen;
      }
      before = now;
    }
    return {Met::nothing, 0.0};
  }

  //! Returns the fraction of a pixel that shows objects.
  [[nodiscard]] float covered_part(int x, int y) const {
    constexpr int samples = 8;
    int covered = 0;
    for (int row = 0; row < samples; ++row) {
      for (int column = 0; column < samples; ++column) {
        covered += seen_at(x + (column + 0.5) / samples, y + (row + 0.5) / samples).met == Met::object ? 1 : 0;
      }
    }
    return static_cast<float>(covered) / (samples * samples);
  }

  //! Returns the minimum and maximum light at 8 x 8 positions in a pixel.
  [[nodiscard]] std::pair<float, float> light_range(int x, int y) const {
    constexpr int samples = 8;
    std::pair<float, float> range = {std::numeric_limits<float>::infinity(), 0.0F};
    for (int i = 0; i < samples * samples; ++i) {
      const int row = i / samples;
      const float light = light_of(seen_at(x + (i % samples + 0.5) / samples, y + (row + 0.5) / samples));
      range = {std::min(range.first, light), std::max(range.second, light)};
    }
    return range;
  }

  //! Returns the light of what was met, without frequency shift. For shells and objects, this is
  //! the light of the first one in the show.
  [[nodiscard]] float light_of(const Seen& seen) const {
    switch (seen.met) {
      case Met::disk:
        return luminance_of(
            disk_light(look_, {1.0F, 0.0F, 1.0F, 1.0F}, {1.0F, static_cast<float>(seen.r), 0.0F, false, 0.0F, 0.0F}));
      case Met::shell: {
        const auto& color = show_.shells.front().fill_color;
        return luminance_of(as_light({color[0], color[1], color[2]}));
      }
      case Met::object:
        return luminance_of(as_light(show_.objects.front().color));
      default:
        return 0.0F;
    }
  }

 private:
  static Vector3<float> as_light(const Vector3<double>& color) {
    return {static_cast<float>(color.x), static_cast<float>(color.y), static_cast<float>(color.z)};
  }

  //! Start and end of the walk in units of the head's radius r, and the factor between successive
  //! distances.
  static constexpr double nearest = 0.04;
  static constexpr double farthest = 16.0;
  static constexpr double step = 1.02;

  //! Returns the factor to the next distance. It is smaller where the line may meet objects.
  [[nodiscard]] double step_at(double s) const {
    double finest = step;
    for (const ObjectSettings& object : show_.objects) {
      const double reach = 2.0 * (std::sqrt(dot(object.position, object.position)) + object.size);
      if (s > head_.r - reach && s < head_.r + 2.0 * reach) {
        finest = std::min(finest, 1.0 + 0.35 * object.size / s);
      }
    }
    return finest;
  }

  //! A point on the line of sight. For each order, `beyond` is its distance beyond the disk's image
  //! in this direction, negative in front of it; `u` is 1/r of the disk there.
  struct LinePoint {
    double s;
    double beyond[crossing_orders];
    double u[crossing_orders];
    bool in_horizon;
    bool in_shell;
    bool in_object;  //!< inside the bounding ball of an object
  };

  //! Returns the point that the head sees in direction n at an affine distance, in pseudo-Cartesian
  //! coordinates. Returns nothing if it is far from the hole or inside the hole.
  [[nodiscard]] std::optional<Vector3<double>> point_at(const Vector3<double>& n, double distance) const {
    constexpr NearParts parts = NearParts::azimuth_and_distance;
    std::optional<Vector3<double>> point;
    follow_path<16, parts>(
        show_.spin, camera_.cosine_phi, camera_.sine_phi, start_near_ray(camera_, n),
        {1.0001 * camera_.horizon_r, 2.0 * head_.r}, {1e-12, 100'000}, true,
        [&](int, const PathStep<16, parts, double>& path) {
          if (path.distance(path.length) < distance) {
            return false;
          }
          point = path.point(find_root(0.0, path.length, [&](double h) { return path.distance(h) - distance; }));
          return true;
        });
    return point;
  }

  //! Returns whether a point is inside a shell around the hole, or outside a shell that encloses
  //! the camera.
  [[nodiscard]] bool is_in_shell(const Vector3<double>& n, double distance,
                                 const std::optional<Vector3<double>>& point) const {
    return std::ranges::any_of(show_.shells, [&](const ShellSettings& shell) {
      return shell.radius < head_.r ? point && dot(*point, *point) < shell.radius * shell.radius
                                    : distance >= affine_distance(camera_, n, shell.radius);
    });
  }

  [[nodiscard]] bool is_in_object(const std::optional<Vector3<double>>& point) const {
    return point && std::ranges::any_of(show_.objects, [&](const ObjectSettings& object) {
             const Vector3<double> way = *point - object.position;
             return dot(way, way) < object.size * object.size;
           });
  }

  [[nodiscard]] LinePoint line_point_at(const Vector3<double>& m, double s) const {
    const Vector3<double> at = eye_ + s * m;
    const double distance = std::sqrt(dot(at, at));
    const Vector3<double> n = (1.0 / distance) * at;
    LinePoint position{};
    position.s = s;
    if (disk_) {
      CrossingLayer<double> layers[crossing_orders];
      trace_layers<14, NearParts::distance>(show_.spin, start_near_ray(camera_, n), limits_, layers);
      for (int k = 0; k < crossing_orders; ++k) {
        position.beyond[k] = distance - layers[k].distance;
        position.u[k] = layers[k].u;
      }
    }
    position.in_horizon =
        !direction_is_bright(camera_, n) && distance >= affine_distance(camera_, n, camera_.horizon_r);
    if (!show_.objects.empty() || !show_.shells.empty()) {
      const std::optional<Vector3<double>> point = point_at(n, distance);
      position.in_object = is_in_object(point);
      position.in_shell = is_in_shell(n, distance, point);
    }
    return position;
  }

  //! Finds what the line meets first between two of its points, to a thousandth of the step.
  [[nodiscard]] Seen between(const Vector3<double>& m, LinePoint low, LinePoint high) const {
    if (first_of(low, high).met == Met::nothing) {
      return {Met::nothing, 0.0};
    }
    for (int round = 0; round < 12; ++round) {
      const LinePoint middle = line_point_at(m, std::sqrt(low.s * high.s));
      (first_of(low, middle).met != Met::nothing ? high : low) = middle;
    }
    return first_of(low, high);
  }

  [[nodiscard]] Seen first_of(const LinePoint& low, const LinePoint& high) const {
    if (high.in_shell && !low.in_shell) {
      return {Met::shell, 0.0};
    }
    if (high.in_object && !low.in_object) {
      return {Met::object, 0.0};
    }
    for (int k = 0; disk_ && k < crossing_orders; ++k) {
      const double u = 0.5 * (low.u[k] + high.u[k]);
      if (low.beyond[k] * high.beyond[k] <= 0.0 && u >= 1.0 / show_.disk->outer &&
          u <= 1.0 / static_cast<double>(look_.inner_r)) {
        return {Met::disk, 1.0 / u};
      }
    }
    return {high.in_horizon && !low.in_horizon ? Met::horizon : Met::nothing, 0.0};
  }

  const Show& show_;
  EyeCamera head_;
  CameraStation camera_;
  Projection projection_;
  Vector3<double> eye_{};
  std::optional<DiskPass> disk_;
  DiskAppearance look_{};
  LayerLimits<double> limits_{};
};

}  // namespace ergodome::test
