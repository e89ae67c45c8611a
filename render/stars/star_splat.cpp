#include "render/stars/star_splat.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "kernels/core/dual.h"
#include "kernels/launch/parallel_for.h"
#include "kernels/launch/work_counter.h"

namespace ergodome {

namespace {

constexpr double cut_off_sigmas = 3.0;
//! Pixels to one side that a spread reaches at the most: a spread of 20 px.
constexpr int widest_px = 60;
constexpr int band_rows = 32;
//! A line across a whole dome of 4k.
constexpr int most_line_points = 8192;

//! Solid angle of the pixel at a place in the image.
double pixel_solid_angle(const Projection& projection, double x_px, double y_px) {
  using D = Dual<double>;
  const Vector3<D> n = direction_from_pixel(projection, D(x_px, 1.0, 0.0), D(y_px, 0.0, 1.0));
  const Vector3<double> area = cross(Vector3<double>{n.x.along_x, n.y.along_x, n.z.along_x},
                                     Vector3<double>{n.x.along_y, n.y.along_y, n.z.along_y});
  return std::sqrt(dot(area, area));
}

//! Parts of a Gaussian that fall on neighbouring pixels, from pixel `first` on; they add up to 1.
struct Spread {
  int first = 0;
  int count = 0;
  std::array<float, 2 * widest_px + 2> part{};

  Spread(double middle_px, double sigma_px, double reach) {
    if (!(sigma_px > 0.0)) {
      first = static_cast<int>(std::floor(middle_px));
      count = 1;
      part[0] = 1.0F;
      return;
    }
    first = static_cast<int>(std::floor(middle_px - reach));
    count = static_cast<int>(std::floor(middle_px + reach)) - first + 1;
    const auto integral = [&](double x) {
      return std::erf(std::clamp(x - middle_px, -reach, reach) / (sigma_px * std::sqrt(2.0)));
    };
    const double whole = integral(middle_px + reach) - integral(middle_px - reach);
    for (int i = 0; i < count; ++i) {
      part[static_cast<std::size_t>(i)] = static_cast<float>((integral(first + i + 1) - integral(first + i)) / whole);
    }
  }
};

//! Adds the pixels of one image that lie in rows [top, bottom); `rgba` begins at row `origin`.
void add(const StarPoint& splat, const Projection& projection, const SplatSettings& settings, int top, int bottom,
         int origin, float* rgba) {
  const double reach = settings.reach_px() - 1.0;
  const Spread across(splat.x_px, settings.sigma_px, reach);
  const Spread down(splat.y_px, settings.sigma_px, reach);
  const bool wraps = projection.kind == ProjectionKind::equirectangular;
  const int width = projection.width_px;
  for (int j = 0; j < down.count; ++j) {
    const int y = down.first + j;
    if (y < top || y >= bottom) {
      continue;
    }
    for (int i = 0; i < across.count; ++i) {
      int x = across.first + i;
      x = wraps ? ((x % width) + width) % width : x;
      if (x < 0 || x >= width) {
        continue;
      }
      const double inside = image_coverage(projection, x + 0.5, y + 0.5);
      const float part = across.part[static_cast<std::size_t>(i)] * down.part[static_cast<std::size_t>(j)] *
                         static_cast<float>(inside);
      float* to = rgba + 4 * (static_cast<std::size_t>(y - origin) * static_cast<std::size_t>(width) +
                              static_cast<std::size_t>(x));
      to[0] += part * splat.light.x;
      to[1] += part * splat.light.y;
      to[2] += part * splat.light.z;
    }
  }
}

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

//! Adds points on the screen.
class PointList {
 public:
  PointList(const Projection& projection, const SplatSettings& settings, std::vector<StarPoint>& points)
      : projection_(projection), settings_(settings), points_(points) {}

  void add(double x, double y, const Vector3<float>& illuminance, bool has_spikes) {
    if (projection_.kind == ProjectionKind::equirectangular) {
      x -= projection_.width_px * std::floor(x / projection_.width_px);
    }
    const double reach = has_spikes ? std::max(settings_.reach_px(), settings_.spike_reach_px) : settings_.reach_px();
    if (is_near_picture(projection_, x, y, reach)) {
      const double solid_angle = pixel_solid_angle(projection_, x, y);
      const Vector3<float> light = (settings_.scale / static_cast<float>(std::max(solid_angle, 1e-12))) * illuminance;
      const float part = has_spikes ? settings_.spike_strength : 0.0F;
      points_.push_back({x, y, (1.0F - part) * light, part * light});
    }
  }

  //! Light spread evenly along a line, at points that are half a pixel apart at the most.
  void add_line(const double (&from)[2], const double (&to)[2], const Vector3<float>& illuminance, bool has_spikes) {
    double way[2] = {to[0] - from[0], to[1] - from[1]};
    if (projection_.kind == ProjectionKind::equirectangular) {
      way[0] -= projection_.width_px * std::round(way[0] / projection_.width_px);
    }
    const int count = std::clamp(static_cast<int>(std::ceil(2.0 * std::hypot(way[0], way[1]))), 1, most_line_points);
    for (int i = 0; i < count; ++i) {
      const double t = (i + 0.5) / count;
      add(from[0] + t * way[0], from[1] + t * way[1], (1.0F / static_cast<float>(count)) * illuminance, has_spikes);
    }
  }

 private:
  const Projection& projection_;
  const SplatSettings& settings_;
  std::vector<StarPoint>& points_;
};

}  // namespace

double SplatSettings::reach_px() const {
  return std::min(cutoff_px > 0.0 ? cutoff_px : cut_off_sigmas * sigma_px, widest_px - 1.0) + 1.0;
}

SplatSettings scaled_to(const SplatSettings& settings, const Projection& projection) {
  constexpr double pixel_of_4k = 3.14159265358979323846 / 4096;
  SplatSettings scaled = settings;
  if (projection.kind != ProjectionKind::pinhole) {
    const double scale = std::max(pixel_of_4k / pixel_angle(projection), 1.0);
    scaled.sigma_px *= scale;
    scaled.cutoff_px *= scale;
  }
  return scaled;
}

std::vector<StarPoint> star_points(const std::vector<StarImage>& images, const EyeCamera& eye,
                                   const Projection& projection, const SplatSettings& settings) {
  std::vector<StarPoint> points;
  points.reserve(images.size());
  PointList list(projection, settings, points);
  for (const StarImage& image : images) {
    double x = 0.0;
    double y = 0.0;
    if (place_on_screen(image.direction, eye, projection, x, y)) {
      list.add(x, y, image.illuminance, has_spikes(image.illuminance, settings));
    }
  }
  std::ranges::stable_sort(points, {}, &StarPoint::y_px);
  return points;
}

std::vector<StarPoint> trail_points(const StarTrails& trails, const Shutter& shutter, const Projection& projection,
                                    const SplatSettings& settings) {
  std::vector<StarPoint> points;
  PointList list(projection, settings, points);
  const float part = 1.0F / static_cast<float>(std::max(trails.places - 1, 1));
  for (std::size_t i = 0; i < trails.ways.size(); ++i) {
    const StarTrails::Way& way = trails.ways[i];
    double before[2] = {};
    bool was_seen = false;
    for (int at = way.first; at <= way.last; ++at) {
      const Vector3<float>& direction =
          trails.directions[i * static_cast<std::size_t>(trails.places) + static_cast<std::size_t>(at)];
      double here[2] = {};
      const bool seen =
          place_on_screen(direction, shutter.eyes[static_cast<std::size_t>(at)], projection, here[0], here[1]);
      if (seen && was_seen) {
        list.add_line(before, here, part * way.illuminance, has_spikes(way.illuminance, settings));
      }
      was_seen = seen;
      std::copy_n(here, 2, before);
    }
  }
  std::ranges::stable_sort(points, {}, &StarPoint::y_px);
  return points;
}

void splat_points(const std::vector<StarPoint>& points, const Projection& projection, const SplatSettings& settings,
                  int first_row, int row_count, float* rgba) {
  static WorkCounter counter("splat_stars");
  const WorkScope work(counter, static_cast<long>(points.size()));
  const double reach = settings.reach_px();
  const int bands = (row_count + band_rows - 1) / band_rows;
  parallel_for(bands, 1, [&](int begin, int end) {
    const int top = first_row + begin * band_rows;
    const int bottom = std::min(first_row + end * band_rows, first_row + row_count);
    auto point = std::ranges::lower_bound(points, top - reach, {}, &StarPoint::y_px);
    for (; point != points.end() && point->y_px < bottom + reach; ++point) {
      add(*point, projection, settings, top, bottom, first_row, rgba);
    }
  });
}

}  // namespace ergodome
