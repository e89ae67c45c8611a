#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "kernels/core/angles.h"
#include "kernels/launch/launch.h"
#include "kernels/launch/parallel_for.h"
#include "kernels/projection/pixel_measure.h"
#include "render/passes/stars/drawing/picture_regions.h"
#include "render/passes/stars/drawing/star_splat.h"

// Positions of star images on the screen, and their brightness.
namespace ergodome {

namespace {

//! Maximum number of points in a line: enough for a line across a whole 4k dome.
constexpr int max_line_points = 8192;

//! Returns the width of a whole turn of azimuth [px]; 0 if azimuth does not run along the rows.
double turn_width_px(const Projection& projection) {
  if (wraps_around(projection)) {
    return projection.width_px;
  }
  const double half_azimuth = projection.kind == ProjectionKind::equirectangular
                                  ? projection.equirectangular.half_azimuth
                              : projection.kind == ProjectionKind::cylinder ? projection.cylinder.half_azimuth
                                                                            : 0.0;
  return half_azimuth > 0.0 ? projection.width_px * pi / half_azimuth : 0.0;
}

double row_of_point(const StarPoint& point) { return std::floor(point.y_px); }

//! Collects points on one region (PictureRegion), in pixel coordinates of the region.
class PointList {
 public:
  PointList(const StarRegion& region, std::vector<StarPoint>& points) : region_(region), points_(points) {}

  [[nodiscard]] const StarRegion& region() const { return region_; }

  void add(double x, double y, const Vector3<float>& illuminance, bool has_spikes) {
    StarPoint point;
    if (point_in_region(region_, x, y, illuminance, has_spikes, point)) {
      points_.push_back(point);
    }
  }

  //! Adds light spread evenly along a line, as points at most half a pixel apart, but at most
  //! max_line_points. Adds nothing for lines entirely beyond one side of the region.
  void add_line(const double (&from)[2], const double (&to)[2], const Vector3<float>& illuminance, bool has_spikes) {
    double way[2] = {to[0] - from[0], to[1] - from[1]};
    double end[2] = {to[0], to[1]};
    // Behind a viewer, azimuth jumps from one end of its range to the other.
    if (const double turn_px = turn_width_px(region_.projection); turn_px > 0.0) {
      way[0] -= turn_px * std::round(way[0] / turn_px);
      end[0] = from[0] + way[0];
    }
    if (passes_by(from, end, has_spikes ? region_.spiked_reach_px : region_.reach_px)) {
      return;
    }
    const int count = std::clamp(static_cast<int>(std::ceil(2.0 * std::hypot(way[0], way[1]))), 1, max_line_points);
    for (int i = 0; i < count; ++i) {
      const double t = (i + 0.5) / count;
      add(from[0] + t * way[0], from[1] + t * way[1], (1.0F / static_cast<float>(count)) * illuminance, has_spikes);
    }
  }

 private:
  //! Returns whether a line is entirely beyond one side of the region, so that it need not be
  //! drawn. In a plane projection, lines far from the center become arbitrarily long.
  [[nodiscard]] bool passes_by(const double (&from)[2], const double (&to)[2], double reach) const {
    const Projection& projection = region_.projection;
    const auto beside = [&](int axis, double size) {
      return std::max(from[axis], to[axis]) < -reach || std::min(from[axis], to[axis]) > size + reach;
    };
    return !wraps_around(projection) && (beside(0, projection.width_px) || beside(1, projection.height_px));
  }

  const StarRegion& region_;
  std::vector<StarPoint>& points_;
};

//! Returns all points row by row from the top; within a row in their original order.
std::vector<StarPoint> by_row(const std::vector<std::vector<StarPoint>>& parts) {
  double top = std::numeric_limits<double>::infinity();
  double bottom = -top;
  for (const std::vector<StarPoint>& part : parts) {
    for (const StarPoint& point : part) {
      top = std::min(top, row_of_point(point));
      bottom = std::max(bottom, row_of_point(point));
    }
  }
  if (!(top <= bottom)) {
    return {};
  }
  // Counting sort: computes the index of the first point of each row.
  std::vector<std::size_t> position(static_cast<std::size_t>(bottom - top) + 2U, 0);
  const auto row = [&](const StarPoint& point) { return static_cast<std::size_t>(row_of_point(point) - top); };
  for (const std::vector<StarPoint>& part : parts) {
    for (const StarPoint& point : part) {
      position[row(point) + 1] += 1;
    }
  }
  std::partial_sum(position.begin(), position.end(), position.begin());
  std::vector<StarPoint> points(position.back());
  for (const std::vector<StarPoint>& part : parts) {
    for (const StarPoint& point : part) {
      points[position[row(point)]++] = point;
    }
  }
  return points;
}

//! Returns all points in their original order.
std::vector<StarPoint> as_they_are(const std::vector<std::vector<StarPoint>>& parts) {
  std::size_t count = 0;
  for (const std::vector<StarPoint>& part : parts) {
    count += part.size();
  }
  std::vector<StarPoint> points;
  points.reserve(count);
  for (const std::vector<StarPoint>& part : parts) {
    points.insert(points.end(), part.begin(), part.end());
  }
  return points;
}

//! Calls body(begin, end, list) for each region of a picture and each chunk of the `count` items,
//! and returns all points that were added to the lists.
template <class Body>
std::vector<StarPoint> points_in_regions(const Projection& projection, const SplatSettings& settings, std::size_t count,
                                         PointOrder order, const Body& body) {
  constexpr std::size_t chunk = 1024;
  const std::vector<StarRegion> regions = star_regions(projection, settings);
  std::vector<std::vector<StarPoint>> parts((count + chunk - 1) / chunk);
  parallel_for(static_cast<int>(parts.size()), 1, [&](int begin, int end) {
    for (auto part = static_cast<std::size_t>(begin); part < static_cast<std::size_t>(end); ++part) {
      for (const StarRegion& region : regions) {
        std::vector<StarPoint>& points = parts[part];
        const std::size_t first = points.size();
        PointList list(region, points);
        body(part * chunk, std::min((part + 1) * chunk, count), list);
        run_on_this_thread(PointLightBatch{region, points.data() + first, static_cast<int>(points.size() - first)});
      }
    }
  });
  return order == PointOrder::by_row ? by_row(parts) : as_they_are(parts);
}

void add_trails(const StarTrails& trails, std::size_t begin, std::size_t end, const Shutter& shutter, PointList& list) {
  const float part = 1.0F / static_cast<float>(std::max(trails.positions - 1, 1));
  for (std::size_t i = begin; i < end; ++i) {
    const StarTrails::Way& way = trails.ways[i];
    double before[2] = {};
    bool was_seen = false;
    for (int at = way.first; at <= way.last; ++at) {
      const Vector3<float>& direction =
          trails.directions[i * static_cast<std::size_t>(trails.positions) + static_cast<std::size_t>(at)];
      const EyeCamera& camera = shutter.eyes[static_cast<std::size_t>(at)].camera;
      double here[2] = {};
      const bool seen =
          project_to_screen(direction, camera.frame_from_view, list.region().projection, here[0], here[1]);
      if (seen && was_seen) {
        list.add_line(before, here, part * way.illuminance, has_spikes(list.region(), way.illuminance));
      }
      was_seen = seen;
      std::copy_n(here, 2, before);
    }
  }
}

}  // namespace

std::vector<StarRegion> star_regions(const Projection& projection, const SplatSettings& settings) {
  std::vector<StarRegion> regions;
  const double reach_px = settings.reach_px();
  for (const PictureRegion& region : picture_regions(projection)) {
    regions.push_back({region.projection, region.cell, static_cast<int>(regions.size()), settings.scale,
                       settings.spikes_from, settings.spike_strength, reach_px,
                       std::max(reach_px, settings.spike_reach_px)});
  }
  return regions;
}

std::vector<StarPoint> star_points(const std::vector<StarImage>& images, const EyeCamera& eye,
                                   const Projection& projection, const SplatSettings& settings, PointOrder order) {
  const auto add_images = [&](std::size_t begin, std::size_t end, PointList& list) {
    for (std::size_t i = begin; i < end; ++i) {
      const StarImage& image = images[i];
      double x = 0.0;
      double y = 0.0;
      if (project_to_screen(image.direction, eye.frame_from_view, list.region().projection, x, y)) {
        list.add(x, y, image.illuminance, has_spikes(list.region(), image.illuminance));
      }
    }
  };
  return points_in_regions(projection, settings, images.size(), order, add_images);
}

std::vector<StarPoint> trail_points(const StarTrails& trails, const Shutter& shutter, const Projection& projection,
                                    const SplatSettings& settings, PointOrder order) {
  const auto add_ways = [&](std::size_t begin, std::size_t end, PointList& list) {
    add_trails(trails, begin, end, shutter, list);
  };
  return points_in_regions(projection, settings, trails.ways.size(), order, add_ways);
}

}  // namespace ergodome
