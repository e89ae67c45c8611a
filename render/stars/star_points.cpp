#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "kernels/launch/parallel_for.h"
#include "kernels/projection/pixel_measure.h"
#include "render/stars/picture_sheets.h"
#include "render/stars/star_splat.h"

// Where on the screen images of stars are, and how bright.
namespace ergodome {

namespace {

//! A line across a whole dome of 4k.
constexpr int most_line_points = 8192;

double row_of_point(const StarPoint& point) { return std::floor(point.y_px); }

//! Where an observer's direction is on the screen.
bool place_on_screen(const Vector3<float>& n, const EyeCamera& eye, const Projection& projection, double& x,
                     double& y) {
  const auto along = [&](int axis) {
    return static_cast<double>(n.x) * eye.frame_from_view[0][axis] +
           static_cast<double>(n.y) * eye.frame_from_view[1][axis] +
           static_cast<double>(n.z) * eye.frame_from_view[2][axis];
  };
  return pixel_from_direction(projection, {along(0), along(1), along(2)}, x, y);
}

//! Whether light there may reach the picture.
bool is_near_picture(const Projection& projection, double x, double y, double reach_px) {
  return x >= -reach_px && x <= projection.width_px + reach_px && y >= -reach_px &&
         y <= projection.height_px + reach_px;
}

bool has_spikes(const Vector3<float>& illuminance, const SplatSettings& settings) {
  return 0.2126729F * illuminance.x + 0.7151522F * illuminance.y + 0.0721750F * illuminance.z >= settings.spikes_from;
}

//! Adds points on a sheet of the screen; places are the sheet's own.
class PointList {
 public:
  PointList(const PictureSheet& sheet, int number, const SplatSettings& settings, std::vector<StarPoint>& points)
      : sheet_(sheet), number_(number), wraps_(wraps_around(sheet.projection)), settings_(settings), points_(points) {}

  void add(double x, double y, const Vector3<float>& illuminance, bool has_spikes) {
    const Projection& projection = sheet_.projection;
    if (wraps_) {
      x -= projection.width_px * std::floor(x / projection.width_px);
    }
    if (is_near_picture(projection, x, y, reach_px(has_spikes))) {
      const double solid_angle = pixel_solid_angle(projection, x, y);
      const Vector3<float> light = (settings_.scale / static_cast<float>(std::max(solid_angle, 1e-12))) * illuminance;
      const float part = has_spikes ? settings_.spike_strength : 0.0F;
      points_.push_back(
          {x + sheet_.cell.left_px, y + sheet_.cell.top_px, (1.0F - part) * light, part * light, number_});
    }
  }

  //! Light spread evenly along a line, at points that are half a pixel apart at the most.
  void add_line(const double (&from)[2], const double (&to)[2], const Vector3<float>& illuminance, bool has_spikes) {
    if (passes_by(from, to, reach_px(has_spikes))) {
      return;
    }
    double way[2] = {to[0] - from[0], to[1] - from[1]};
    if (wraps_) {
      way[0] -= sheet_.projection.width_px * std::round(way[0] / sheet_.projection.width_px);
    }
    const int count = std::clamp(static_cast<int>(std::ceil(2.0 * std::hypot(way[0], way[1]))), 1, most_line_points);
    for (int i = 0; i < count; ++i) {
      const double t = (i + 0.5) / count;
      add(from[0] + t * way[0], from[1] + t * way[1], (1.0F / static_cast<float>(count)) * illuminance, has_spikes);
    }
  }

 private:
  [[nodiscard]] double reach_px(bool has_spikes) const {
    return has_spikes ? std::max(settings_.reach_px(), settings_.spike_reach_px) : settings_.reach_px();
  }

  //! Whether a line lies beside the sheet, all of it on one side: on a plane far from its middle lines get as long as one likes.
  [[nodiscard]] bool passes_by(const double (&from)[2], const double (&to)[2], double reach) const {
    const auto beside = [&](int axis, double size) {
      return std::max(from[axis], to[axis]) < -reach || std::min(from[axis], to[axis]) > size + reach;
    };
    return !wraps_ && (beside(0, sheet_.projection.width_px) || beside(1, sheet_.projection.height_px));
  }

  const PictureSheet& sheet_;
  int number_;
  bool wraps_;
  const SplatSettings& settings_;
  std::vector<StarPoint>& points_;
};

//! All points, row by row from the top; in a row in their order.
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
  // Sorting by counting: where each row begins.
  std::vector<std::size_t> place(static_cast<std::size_t>(bottom - top) + 2U, 0);
  const auto row = [&](const StarPoint& point) { return static_cast<std::size_t>(row_of_point(point) - top); };
  for (const std::vector<StarPoint>& part : parts) {
    for (const StarPoint& point : part) {
      place[row(point) + 1] += 1;
    }
  }
  std::partial_sum(place.begin(), place.end(), place.begin());
  std::vector<StarPoint> points(place.back());
  for (const std::vector<StarPoint>& part : parts) {
    for (const StarPoint& point : part) {
      points[place[row(point)]++] = point;
    }
  }
  return points;
}

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

//! Calls body(sheet's projection, begin, end, list) for each sheet of a picture and each part of `count` things; returns the points.
template <class Body>
std::vector<StarPoint> points_on_sheets(const Projection& projection, const SplatSettings& settings, std::size_t count,
                                        PointOrder order, const Body& body) {
  constexpr std::size_t chunk = 1024;
  const std::vector<PictureSheet> sheets = picture_sheets(projection);
  std::vector<std::vector<StarPoint>> parts((count + chunk - 1) / chunk);
  parallel_for(static_cast<int>(parts.size()), 1, [&](int begin, int end) {
    for (auto part = static_cast<std::size_t>(begin); part < static_cast<std::size_t>(end); ++part) {
      for (std::size_t i = 0; i < sheets.size(); ++i) {
        PointList list(sheets[i], static_cast<int>(i), settings, parts[part]);
        body(sheets[i].projection, part * chunk, std::min((part + 1) * chunk, count), list);
      }
    }
  });
  return order == PointOrder::by_row ? by_row(parts) : as_they_are(parts);
}

void add_trails(const StarTrails& trails, std::size_t begin, std::size_t end, const Shutter& shutter,
                const Projection& projection, const SplatSettings& settings, PointList& list) {
  const float part = 1.0F / static_cast<float>(std::max(trails.places - 1, 1));
  for (std::size_t i = begin; i < end; ++i) {
    const StarTrails::Way& way = trails.ways[i];
    double before[2] = {};
    bool was_seen = false;
    for (int at = way.first; at <= way.last; ++at) {
      const Vector3<float>& direction =
          trails.directions[i * static_cast<std::size_t>(trails.places) + static_cast<std::size_t>(at)];
      double here[2] = {};
      const bool seen =
          place_on_screen(direction, shutter.eyes[static_cast<std::size_t>(at)].camera, projection, here[0], here[1]);
      if (seen && was_seen) {
        list.add_line(before, here, part * way.illuminance, has_spikes(way.illuminance, settings));
      }
      was_seen = seen;
      std::copy_n(here, 2, before);
    }
  }
}

}  // namespace

std::vector<StarPoint> star_points(const std::vector<StarImage>& images, const EyeCamera& eye,
                                   const Projection& projection, const SplatSettings& settings, PointOrder order) {
  const auto add_images = [&](const Projection& sheet, std::size_t begin, std::size_t end, PointList& list) {
    for (std::size_t i = begin; i < end; ++i) {
      const StarImage& image = images[i];
      double x = 0.0;
      double y = 0.0;
      if (place_on_screen(image.direction, eye, sheet, x, y)) {
        list.add(x, y, image.illuminance, has_spikes(image.illuminance, settings));
      }
    }
  };
  return points_on_sheets(projection, settings, images.size(), order, add_images);
}

std::vector<StarPoint> trail_points(const StarTrails& trails, const Shutter& shutter, const Projection& projection,
                                    const SplatSettings& settings, PointOrder order) {
  const auto add_ways = [&](const Projection& sheet, std::size_t begin, std::size_t end, PointList& list) {
    add_trails(trails, begin, end, shutter, sheet, settings, list);
  };
  return points_on_sheets(projection, settings, trails.ways.size(), order, add_ways);
}

}  // namespace ergodome
