#include "render/stars/star_splat.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "kernels/core/dual.h"
#include "kernels/launch/parallel_for.h"

namespace ergodome {

namespace {

constexpr double cut_off_sigmas = 3.0;
//! Pixels to one side that a spread reaches at the most: a spread of 20 px.
constexpr int widest_px = 60;
constexpr int band_rows = 32;

//! An image on the screen.
struct Splat {
  double x_px;
  double y_px;
  Vector3<float> light;  //!< picture value times pixels
};

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

  Spread(double middle_px, double sigma_px) {
    if (!(sigma_px > 0.0)) {
      first = static_cast<int>(std::floor(middle_px));
      count = 1;
      part[0] = 1.0F;
      return;
    }
    const double reach = std::min(cut_off_sigmas * sigma_px, widest_px - 1.0);
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

//! The images that lie on the screen or beside it, from the top down.
std::vector<Splat> on_screen(const std::vector<StarImage>& images, const EyeCamera& eye, const Projection& projection,
                             const SplatSettings& settings, double reach_px) {
  std::vector<Splat> splats;
  splats.reserve(images.size());
  for (const StarImage& image : images) {
    const Vector3<float>& n = image.direction;
    const auto along = [&](int axis) {
      return static_cast<double>(n.x) * eye.frame_from_view[0][axis] +
             static_cast<double>(n.y) * eye.frame_from_view[1][axis] +
             static_cast<double>(n.z) * eye.frame_from_view[2][axis];
    };
    double x = 0.0;
    double y = 0.0;
    if (!pixel_from_direction(projection, {along(0), along(1), along(2)}, x, y) || x < -reach_px ||
        x > projection.width_px + reach_px || y < -reach_px || y > projection.height_px + reach_px) {
      continue;
    }
    const double solid_angle = pixel_solid_angle(projection, x, y);
    const float scale = settings.scale / static_cast<float>(std::max(solid_angle, 1e-12));
    splats.push_back({x, y, scale * image.illuminance});
  }
  std::ranges::stable_sort(splats, {}, &Splat::y_px);
  return splats;
}

//! Adds the pixels of one image that lie in rows [top, bottom); `rgba` begins at row `origin`.
void add(const Splat& splat, const Projection& projection, double sigma_px, int top, int bottom, int origin,
         float* rgba) {
  const Spread across(splat.x_px, sigma_px);
  const Spread down(splat.y_px, sigma_px);
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

}  // namespace

void splat_stars(const std::vector<StarImage>& images, const EyeCamera& eye, const Projection& projection,
                 const SplatSettings& settings, int first_row, int row_count, float* rgba) {
  const double reach = std::min(cut_off_sigmas * settings.sigma_px, widest_px - 1.0) + 1.0;
  const std::vector<Splat> splats = on_screen(images, eye, projection, settings, reach);
  const int bands = (row_count + band_rows - 1) / band_rows;
  parallel_for(bands, 1, [&](int begin, int end) {
    const int top = first_row + begin * band_rows;
    const int bottom = std::min(first_row + end * band_rows, first_row + row_count);
    auto splat = std::ranges::lower_bound(splats, top - reach, {}, &Splat::y_px);
    for (; splat != splats.end() && splat->y_px < bottom + reach; ++splat) {
      add(*splat, projection, settings.sigma_px, top, bottom, first_row, rgba);
    }
  });
}

}  // namespace ergodome
