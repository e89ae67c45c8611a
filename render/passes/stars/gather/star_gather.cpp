#include "render/passes/stars/gather/star_gather.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "kernels/launch/parallel_for.h"
#include "kernels/launch/work_counter.h"
#include "render/passes/stars/gather/corner_rows.h"

namespace ergodome {

namespace {

//! Number of pixel rows whose corners are stored at a time.
constexpr int block_rows = 32;
//! Maximum chord between the center of a polygon and its farthest corner (a quarter of a radian).
//! Wider polygons are skipped.
constexpr double widest_chord = 0.2493;
//! Minimum distance of a star from the edges of its pixel [px], so that rounding its position to
//! float does not move it to another pixel.
constexpr double seam_margin_px = 2e-3;

//! Returns the solid angle of a triangle [sr], positive if a, b, c run counterclockwise seen from
//! outside the sphere (Van Oosterom & Strackee, IEEE TBME 30 (1983), eq. 8).
double signed_solid_angle(const Vector3<double>& a, const Vector3<double>& b, const Vector3<double>& c) {
  return 2.0 * std::atan2(dot(a, cross(b - a, c - a)), 1.0 + dot(a, b) + dot(b, c) + dot(c, a));
}

//! Indices of a pixel's corners: top left, top right, bottom right, bottom left. `halves` divides
//! the pixel into two triangles.
using CornerIndices = std::array<int, 4>;
constexpr std::size_t halves[2][3] = {{0, 1, 2}, {0, 2, 3}};
constexpr int right_of[4] = {0, 1, 1, 0};
constexpr int below[4] = {0, 0, 1, 1};

//! Gathers the stars of the pixels, row by row.
class Gatherer {
 public:
  Gatherer(const StarField& field, const StarTree& tree, const BlackbodyTable& colours, const Projection& projection,
           const StarSettings& settings, const CornerRows& corners)
      : field_(field),
        tree_(tree),
        colours_(colours),
        projection_(projection),
        settings_(settings),
        corners_(corners) {}

  void gather_row(int y, std::vector<int>& room, GatheredStars& into) const {
    for (int x = 0; x < projection_.width_px; ++x) {
      if (!(image_coverage(projection_, x + 0.5, y + 0.5) > 0.0)) {
        continue;
      }
      CornerIndices quad{};
      for (std::size_t i = 0; i < 4; ++i) {
        quad[i] = corners_.number(y + below[i], x + right_of[i]);
      }
      if (!std::ranges::all_of(quad, [&](int corner) { return corners_[corner].seen; })) {
        ++into.shadowed_pixels;
      } else if (!search(quad, room)) {
        ++into.stretched_pixels;
      } else if (!room.empty()) {
        gather_pixel(x, y, quad, room, into.stars);
      }
    }
  }

 private:
  //! Finds the stars that may lie in a polygon. Returns false if the polygon is too wide.
  bool search(const CornerIndices& quad, std::vector<int>& found) const {
    Vector3<double> middle{};
    for (const int corner : quad) {
      middle = middle + corners_[corner].sky;
    }
    middle = (1.0 / std::max(std::sqrt(dot(middle, middle)), 1e-30)) * middle;
    double square = 0.0;
    for (const int corner : quad) {
      const Vector3<double> apart = corners_[corner].sky - middle;
      square = std::max(square, dot(apart, apart));
    }
    const double chord = std::sqrt(square);
    if (!(chord <= widest_chord)) {
      return false;
    }
    tree_.search(middle, chord * (1.0 + 1e-6) + 1e-12, found);
    return true;
  }

  //! Returns whether a star is to the left of the arc from one corner to another. `weight`: its
  //! distance from the arc's plane times the arc's length.
  //!
  //! The sign is always computed for the direction from the lower to the higher corner index, and a
  //! star exactly on the arc counts as left of that direction. Therefore the polygons on both sides
  //! of an edge get consistent results, and exactly one of them contains the star.
  [[nodiscard]] bool is_left(const Vector3<double>& star, int from, int to, double& weight) const {
    const bool forwards = from < to;
    const double side = dot(star, cross(corners_[std::min(from, to)].sky, corners_[std::max(from, to)].sky));
    weight = std::abs(side);
    return (side >= 0.0) == forwards;
  }

  //! Returns whether a triangle of the polygon contains a star, which must be on the triangle's
  //! side of the sky, as those found by search() are. The triangle may be mirrored. `weights`:
  //! barycentric weights of its corners, not normalized.
  [[nodiscard]] bool holds(const CornerIndices& quad, const std::size_t (&half)[3], const Vector3<double>& star,
                           double (&weights)[3]) const {
    const bool first = is_left(star, quad[half[0]], quad[half[1]], weights[2]);
    const bool second = is_left(star, quad[half[1]], quad[half[2]], weights[0]);
    const bool third = is_left(star, quad[half[2]], quad[half[0]], weights[1]);
    return first == second && second == third;
  }

  //! Returns the corner of a triangle that a star coincides with within rounding, or -1.
  static int corner_with_all(const double (&weights)[3]) {
    constexpr double rounding = 1e-13;
    const double whole = weights[0] + weights[1] + weights[2];
    for (int i = 0; i < 3; ++i) {
      if (whole - weights[i] < rounding * whole) {
        return i;
      }
    }
    return -1;
  }

  void gather_pixel(int x, int y, const CornerIndices& quad, const std::vector<int>& near,
                    std::vector<GatheredStar>& into) const;
  bool shine(GatheredStar& gathered) const;

  const StarField& field_;
  const StarTree& tree_;
  const BlackbodyTable& colours_;
  const Projection& projection_;
  const StarSettings& settings_;
  const CornerRows& corners_;
};

void Gatherer::gather_pixel(int x, int y, const CornerIndices& quad, const std::vector<int>& near,
                            std::vector<GatheredStar>& into) const {
  Vector3<double> view[4];
  double g = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    view[i] = direction_from_pixel<double>(projection_, x + right_of[i], y + below[i]);
    g += 0.25 * corners_[quad[i]].frequency_ratio;
  }
  double on_screen[2];
  double on_sky[2];
  for (std::size_t i = 0; i < 2; ++i) {
    const auto& [a, b, c] = halves[i];
    on_screen[i] = signed_solid_angle(view[a], view[b], view[c]);
    on_sky[i] = signed_solid_angle(corners_[quad[a]].sky, corners_[quad[b]].sky, corners_[quad[c]].sky);
  }
  const double magnification =
      (std::abs(on_screen[0]) + std::abs(on_screen[1])) / std::max(std::abs(on_sky[0]) + std::abs(on_sky[1]), 1e-30);
  for (const int star : near) {
    for (std::size_t i = 0; i < 2; ++i) {
      double weights[3];
      const bool held = holds(quad, halves[i], field_.stars()[static_cast<std::size_t>(star)].direction, weights);
      const int corner_of_star = corner_with_all(weights);
      const bool at_corner = corner_of_star >= 0;
      // At a corner, the rounded signs of all edges that meet there may be inconsistent. A star
      // exactly at a corner is therefore assigned to the pixel below and to the right of it.
      const bool at_own = at_corner && i == 0 && halves[0][static_cast<std::size_t>(corner_of_star)] == 0;
      if (at_corner ? !at_own : !held) {
        continue;
      }
      const double whole = std::max(weights[0] + weights[1] + weights[2], 1e-300);
      GatheredStar gathered{star, x, y, 0.0F, 0.0F, static_cast<float>(g), 0.0F, {}};
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const auto part = static_cast<float>(weights[corner] / whole);
        gathered.x_inside += part * static_cast<float>(right_of[halves[i][corner]]);
        gathered.y_inside += part * static_cast<float>(below[halves[i][corner]]);
      }
      gathered.magnification = static_cast<float>(on_screen[i] * on_sky[i] < 0.0 ? -magnification : magnification);
      if (shine(gathered)) {
        into.push_back(gathered);
      }
    }
  }
}

//! Computes the light of a gathered star. Returns false if it is too faint.
bool Gatherer::shine(GatheredStar& gathered) const {
  const FieldStar& star = field_.stars()[static_cast<std::size_t>(gathered.star)];
  const float magnification = std::abs(gathered.magnification);
  const Vector3<float> light = star_light(colours_, star.log_temperature, star.illuminance,
                                          settings_.redshift ? gathered.frequency_ratio : 1.0F, magnification);
  gathered.illuminance = settings_.magnification ? light : (1.0F / magnification) * light;
  return 0.2126729F * light.x + 0.7151522F * light.y + 0.0721750F * light.z >= settings_.faintest;
}

}  // namespace

GatheredStars gather_stars(const StarField& field, const StarTree& tree, const BlackbodyTable& colours,
                           const StarEye& eye, const Projection& projection, const StarSettings& settings) {
  static WorkCounter counter("gather_stars");
  const WorkScope work(counter, static_cast<long>(projection.width_px) * projection.height_px);
  GatheredStars all;
  CornerRows corners(eye, projection);
  const Gatherer gatherer(field, tree, colours, projection, settings, corners);
  for (int first_row = 0; first_row < projection.height_px; first_row += block_rows) {
    const int row_count = std::min(block_rows, projection.height_px - first_row);
    corners.trace(first_row, row_count);
    // The stars of each row of pixels are collected separately, so that their order does not depend
    // on the threads.
    std::vector<GatheredStars> rows(static_cast<std::size_t>(row_count));
    parallel_for(row_count, 1, [&](int begin, int end) {
      std::vector<int> room;
      for (int row = begin; row < end; ++row) {
        gatherer.gather_row(first_row + row, room, rows[static_cast<std::size_t>(row)]);
      }
    });
    for (const GatheredStars& row : rows) {
      all.stars.insert(all.stars.end(), row.stars.begin(), row.stars.end());
      all.shadowed_pixels += row.shadowed_pixels;
      all.stretched_pixels += row.stretched_pixels;
    }
  }
  return all;
}

std::vector<StarImage> star_images(const std::vector<GatheredStar>& gathered, const EyeCamera& eye,
                                   const Projection& projection) {
  std::vector<StarImage> images;
  images.reserve(gathered.size());
  for (const GatheredStar& star : gathered) {
    const auto position = [](int pixel, float inside) {
      return pixel + std::clamp(static_cast<double>(inside), seam_margin_px, 1.0 - seam_margin_px);
    };
    const Vector3<double> view =
        direction_from_pixel(projection, position(star.x_px, star.x_inside), position(star.y_px, star.y_inside));
    const auto along = [&](int axis) {
      const auto& row = eye.frame_from_view[axis];
      return static_cast<float>(row[0] * view.x + row[1] * view.y + row[2] * view.z);
    };
    images.push_back(
        {star.star, {along(0), along(1), along(2)}, star.magnification, star.frequency_ratio, star.illuminance});
  }
  return images;
}

}  // namespace ergodome
