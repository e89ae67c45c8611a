#include "render/channels/pixel_channels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "kernels/core/angles.h"
#include "kernels/core/dual.h"
#include "kernels/launch/launch.h"
#include "kernels/launch/parallel_for.h"
#include "kernels/spacetime/geodesic/taylor.h"
#include "render/channels/disk_channels.h"
#include "render/lens/direct_lens.h"

namespace ergodome {

namespace {

using Derived = Dual<double>;

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

//! Number of pixels per block.
constexpr int traced_block_px = 1 << 15;
constexpr int rays_of_a_task = 64;

//! With this tolerance, the accuracy of derivatives is limited only by the number of terms.
constexpr double derivative_tolerance = 1e-12;

template <class T>
Vector3<T> turned_from_view(const EyeCamera& eye, const Vector3<T>& view) {
  const auto row = [&](int i) {
    const double(&m)[3] = eye.frame_from_view[i];
    return view.x * m[0] + view.y * m[1] + view.z * m[2];
  };
  return {row(0), row(1), row(2)};
}

//! Returns the angle of the direction (x, y) in [0, 360) [deg].
double turn_deg(double y, double x) {
  const double angle = radian_deg * std::atan2(y, x);
  return angle < 0.0 ? angle + 360.0 : angle;
}

double latitude_deg(const Vector3<double>& v) { return radian_deg * std::atan2(v.z, std::hypot(v.x, v.y)); }

//! The pixels of a block whose centers are inside the image, and their rays.
struct RayBlock {
  std::vector<std::size_t> pixels;
  std::array<std::vector<double>, 3> n, sky;
  std::vector<double> g, status, steps, error, mino_time;

  [[nodiscard]] Vector3<double> direction(std::size_t i) const { return {n[0][i], n[1][i], n[2][i]}; }
  [[nodiscard]] Vector3<double> source(std::size_t i) const { return {sky[0][i], sky[1][i], sky[2][i]}; }
  [[nodiscard]] bool has(std::size_t i, LightEnd wanted) const {
    return status[i] == static_cast<double>(static_cast<int>(wanted));
  }
};

//! Traces the blocks of a picture and stores the values of its channels.
class ChannelTracer {
 public:
  ChannelTracer(const ChannelScene& scene, const std::vector<ChannelGroup>& groups)
      : scene_(scene),
        groups_(groups),
        camera_(station_of(scene.eye)),
        disk_(camera_, {scene.disk_inner, scene.disk_outer}) {
    const auto pixels =
        static_cast<std::size_t>(scene.projection.width_px) * static_cast<std::size_t>(scene.projection.height_px);
    for (const ChannelGroup group : groups) {
      first_.push_back(found_.channels.size());
      meets_disk_ = meets_disk_ || is_of_disk(group);
      for (const ChannelMeaning& meaning : channels_of(group)) {
        found_.channels.push_back({meaning, std::vector<double>(pixels, no_number)});
      }
    }
  }

  void trace_block(std::size_t begin, std::size_t end) {
    RayBlock rays = rays_of(begin, end);
    trace_sky(rays);
    std::vector<char> lost(rays.pixels.size(), 0);
    parallel_for(static_cast<int>(rays.pixels.size()), rays_of_a_task, [&](int from, int to) {
      for (int i = from; i < to; ++i) {
        const auto at = static_cast<std::size_t>(i);
        lost[at] = store(rays, at) ? 0 : 1;
      }
    });
    found_.unresolved += std::ranges::count(lost, 1);
  }

  PixelChannels take() { return std::move(found_); }

 private:
  RayBlock rays_of(std::size_t begin, std::size_t end) const {
    const Projection& projection = scene_.projection;
    RayBlock rays;
    for (std::size_t pixel = begin; pixel < end; ++pixel) {
      const auto [x, y] = middle_of(pixel);
      if (!(image_coverage(projection, x, y) >= 0.5)) {
        continue;
      }
      const Vector3<double> n = turned_from_view(scene_.eye, direction_from_pixel(projection, x, y));
      rays.pixels.push_back(pixel);
      rays.n[0].push_back(n.x);
      rays.n[1].push_back(n.y);
      rays.n[2].push_back(n.z);
    }
    for (auto* each :
         {&rays.sky[0], &rays.sky[1], &rays.sky[2], &rays.g, &rays.status, &rays.steps, &rays.error, &rays.mino_time}) {
      each->resize(rays.pixels.size());
    }
    return rays;
  }

  [[nodiscard]] std::pair<double, double> middle_of(std::size_t pixel) const {
    const auto width = static_cast<std::size_t>(scene_.projection.width_px);
    const std::size_t row = pixel / width;
    return {static_cast<double>(pixel % width) + 0.5, static_cast<double>(row) + 0.5};
  }

  void trace_sky(RayBlock& rays) const {
    RayBatch<double> batch{};
    batch.camera = camera_;
    batch.settings = {channel_tolerance, channel_step_limit};
    batch.method = TraceMethod::taylor;
    batch.count = static_cast<int>(rays.pixels.size());
    for (std::size_t k = 0; k < 3; ++k) {
      batch.direction[k] = rays.n[k].data();
      batch.sky[k] = rays.sky[k].data();
    }
    batch.frequency_ratio = rays.g.data();
    batch.status = rays.status.data();
    batch.steps = rays.steps.data();
    batch.error_estimate = rays.error.data();
    batch.mino_time = rays.mino_time.data();
    if (batch.count > 0) {
      launch(Backend::cpu, batch);
    }
  }

  //! Stores the channel values of a ray's pixel. Returns whether all of its rays converged.
  bool store(const RayBlock& rays, std::size_t i) {
    const std::optional<DiskCrossings> crossings = meets_disk_ ? disk_.trace(rays.direction(i)) : DiskCrossings{};
    bool resolved = crossings && !rays.has(i, LightEnd::unresolved);
    const bool lit = rays.has(i, LightEnd::sky);
    for (std::size_t group = 0; group < groups_.size(); ++group) {
      const auto put = [&](std::size_t channel, double value) {
        found_.channels[first_[group] + channel].values[rays.pixels[i]] = value;
      };
      switch (groups_[group]) {
        case ChannelGroup::direction:
          for (std::size_t k = 0; k < 3; ++k) {
            put(k, rays.n[k][i]);
          }
          break;
        case ChannelGroup::disk:
        case ChannelGroup::disk_0:
        case ChannelGroup::disk_1:
        case ChannelGroup::disk_2:
          if (crossings) {
            store_disk(groups_[group], *crossings, put);
          }
          break;
        case ChannelGroup::magnification:
          if (lit) {
            const std::optional<double> value = magnification(rays.pixels[i]);
            resolved = resolved && value;
            put(0, value.value_or(no_number));
          }
          break;
        default:
          if (lit) {
            store_sky(groups_[group], rays, i, put);
          }
          break;
      }
    }
    return resolved;
  }

  template <class Put>
  void store_sky(ChannelGroup group, const RayBlock& rays, std::size_t i, const Put& put) const {
    const Vector3<double> sky = rays.source(i);
    switch (group) {
      case ChannelGroup::g:
        return put(0, rays.g[i]);
      case ChannelGroup::order: {
        const double half_turns = swept_half_turns(rays, i);
        put(0, std::floor(half_turns));
        return put(1, half_turns);
      }
      case ChannelGroup::sky:
        put(0, turn_deg(sky.y, sky.x));
        return put(1, latitude_deg(sky));
      case ChannelGroup::equatorial: {
        const glm::dvec3 there = scene_.equatorial_from_sky * glm::dvec3(sky.x, sky.y, sky.z);
        put(0, turn_deg(there.y, there.x));
        return put(1, latitude_deg({there.x, there.y, there.z}));
      }
      case ChannelGroup::mino_time:
        return put(0, rays.mino_time[i]);
      case ChannelGroup::steps:
        return put(0, rays.steps[i]);
      case ChannelGroup::error:
        return put(0, rays.error[i]);
      default:
        break;
    }
  }

  //! Returns the angle that the ray sweeps around the hole, in half turns: |m'| times the Mino
  //! time, over π. m is the unit vector from the hole to the ray's position, and m' its derivative
  //! by Mino time, whose length is computed with the mean of m_z² at both ends. Exact for a hole
  //! without spin. kernels/spacetime/trace/trace_pixels_kernel.h uses the same formula.
  [[nodiscard]] double swept_half_turns(const RayBlock& rays, std::size_t i) const {
    const RayStart<double> start = start_ray(camera_, rays.direction(i));
    const double square = 0.5 * (start.m.z * start.m.z + rays.sky[2][i] * rays.sky[2][i]);
    const double rate = std::sqrt(std::max(start.polar_constant + camera_.spin * camera_.spin * square, 0.0));
    return rate * rays.mino_time[i] / pi;
  }

  //! Returns the solid angle of a pixel in the view over that on the sky, from exact derivatives of
  //! the sky direction per pixel; negative where the image is mirrored, nothing if the ray does not
  //! converge.
  [[nodiscard]] std::optional<double> magnification(std::size_t pixel) const {
    const auto [x, y] = middle_of(pixel);
    const Vector3<Derived> view = direction_from_pixel(scene_.projection, Derived(x, 1.0, 0.0), Derived(y, 0.0, 1.0));
    const Vector3<Derived> n = turned_from_view(scene_.eye, view);
    double steps = 0.0;
    bool reached = true;
    const RayEnd<Derived> end = trace_taylor<20>(camera_.spin, start_ray(camera_, n), true,
                                                 {derivative_tolerance, channel_step_limit}, steps, reached);
    const auto area = [](const Vector3<Derived>& v) {
      return dot({v.x.value, v.y.value, v.z.value}, cross(Vector3<double>{v.x.along_x, v.y.along_x, v.z.along_x},
                                                          Vector3<double>{v.x.along_y, v.y.along_y, v.z.along_y}));
    };
    return reached ? std::optional(area(n) / area(end.sky)) : std::nullopt;
  }

  template <class Put>
  static void store_disk(ChannelGroup group, const DiskCrossings& crossings, const Put& put) {
    const auto write = [&](const DiskCrossing& at) {
      put(0, at.r);
      put(1, at.azimuth_deg);
      put(2, at.frequency_ratio);
      put(3, at.delay);
    };
    if (group != ChannelGroup::disk) {
      const auto order = static_cast<std::size_t>(group) - static_cast<std::size_t>(ChannelGroup::disk_0);
      if (crossings[order]) {
        write(*crossings[order]);
      }
      return;
    }
    const auto* const first = std::ranges::find_if(crossings, [](const auto& at) { return at.has_value(); });
    if (first != crossings.end()) {
      write(**first);
      put(4, static_cast<double>(first - crossings.begin()));
    }
  }

  const ChannelScene& scene_;
  const std::vector<ChannelGroup>& groups_;
  CameraStation camera_;
  DiskTracer disk_;
  bool meets_disk_ = false;
  std::vector<std::size_t> first_;  //!< index of each group's first channel in found_.channels
  PixelChannels found_;
};

}  // namespace

PixelChannels trace_channels(const ChannelScene& scene, const std::vector<ChannelGroup>& groups,
                             const std::function<bool()>& advance) {
  const auto pixels =
      static_cast<std::size_t>(scene.projection.width_px) * static_cast<std::size_t>(scene.projection.height_px);
  ChannelTracer tracer(scene, groups);
  for (std::size_t begin = 0; begin < pixels && advance(); begin += traced_block_px) {
    tracer.trace_block(begin, std::min(begin + traced_block_px, pixels));
  }
  return tracer.take();
}

}  // namespace ergodome
