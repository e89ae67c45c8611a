#include "render/passes/sky/polygon_filter.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>

#include "content/sky/sky_map.h"
#include "kernels/core/angles.h"
#include "kernels/launch/parallel_for.h"
#include "kernels/launch/work_counter.h"

namespace ergodome {

namespace {

//! Maximum angle between a pixel's center and its farthest corner [rad]. Pixels with a larger one
//! get the mean of the whole sky.
constexpr double widest_corner = 1.25;
//! Minimum width of the outline of a pixel on the sky map [texels]. Rounding errors would dominate
//! narrower outlines, which occur at caustics.
constexpr double min_width = 0.01;
//! Accepted error of a side of an outline, as a fraction of the outline's width.
constexpr double part_off = 0.01;
constexpr int max_splits = 12;

//! Moves a direction on the sphere along a tangent, by an angle equal to the tangent's length.
glm::dvec3 moved(const glm::dvec3& direction, const glm::dvec3& tangent) {
  const double angle = glm::length(tangent);
  return angle > 0.0 ? std::cos(angle) * direction + (std::sin(angle) / angle) * tangent : direction;
}

//! Widens a parallelogram on the sphere, given by two tangents at `direction`, so that its area is
//! not zero. `minimum`: minimum width [rad].
void widen(const glm::dvec3& direction, double minimum, glm::dvec3& first, glm::dvec3& second) {
  glm::dvec3& longer = glm::dot(first, first) >= glm::dot(second, second) ? first : second;
  glm::dvec3& shorter = &longer == &first ? second : first;
  if (!(glm::length(longer) >= minimum)) {
    const glm::dvec3 axis = std::abs(direction.z) < 0.9 ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(1.0, 0.0, 0.0);
    longer = minimum * glm::normalize(glm::cross(axis, direction));
  }
  const glm::dvec3 across = glm::normalize(glm::cross(direction, longer));
  const double apart = glm::dot(shorter, across);
  if (!(std::abs(apart) >= minimum)) {
    shorter += (std::copysign(minimum, apart) - apart) * across;
  }
}

std::size_t wrapped(int column, int width) { return static_cast<std::size_t>(((column % width) + width) % width); }

glm::dvec3 vector_at(const float* const (&from)[3], int index) {
  return {from[0][index], from[1][index], from[2][index]};
}

}  // namespace

PolygonFilter::PolygonFilter(const EnvironmentImage& image, const glm::dmat3& sky_from_map, const TemperatureFit* fit)
    : sums_(image, fit), map_from_sky_(glm::transpose(sky_from_map)) {
  for (int column = 0; column < image.width; ++column) {
    const glm::dvec3 on_it = direction_from_map(static_cast<double>(column) / image.width, 0.5);
    normals_.emplace_back(-on_it.y, on_it.x);
  }
}

double PolygonFilter::column_of(const glm::dvec3& direction) const {
  return map_from_direction(direction).x * sums_.width();
}

void PolygonFilter::add_piece(int column, const OutlinePoint& from, const OutlinePoint& to, int depth, Sum& sum) const {
  // A great circle of length l deviates from a straight line in the map by l² / 8, divided by the
  // distance from the pole, because longitude scales inversely with that distance.
  const glm::dvec3 chord = to.direction - from.direction;
  const double highest = std::max(std::abs(from.in_column.sine), std::abs(to.in_column.sine));
  const double from_pole = std::sqrt(std::max(1.0 - highest * highest, 0.0));
  if (depth > 0 && from.in_column.row != to.in_column.row && glm::dot(chord, chord) > sum.tolerance * from_pole) {
    const glm::dvec3 middle = glm::normalize(from.direction + to.direction);
    const double turn = std::remainder(column_of(middle) - from.column, static_cast<double>(sums_.width()));
    const double low = std::min(from.column, to.column);
    const double high = std::max(from.column, to.column);
    const OutlinePoint half = {middle, std::clamp(from.column + turn, low, high), sums_.position_of(middle.z)};
    add_piece(column, from, half, depth - 1, sum);
    return add_piece(column, half, to, depth - 1, sum);
  }
  const double part = to.column - from.column;
  sums_.add_above(column, from.in_column, to.in_column, part, sum.light);
  sum.area += part * (1.0 - 0.5 * (from.in_column.sine + to.in_column.sine));
}

void PolygonFilter::add_side(const glm::dvec3& from, const glm::dvec3& to, Sum& sum) const {
  const int width = sums_.width();
  OutlinePoint at = {from, column_of(from), sums_.position_of(from.z)};
  const double turn = std::remainder(column_of(to) - at.column, static_cast<double>(width));
  const OutlinePoint end = {to, at.column + turn, sums_.position_of(to.z)};
  const glm::dvec3 way = to - from;
  // Finds the crossings of the side, along its straight chord, with the meridians between columns.
  const int step = turn >= 0.0 ? 1 : -1;
  int meridian = static_cast<int>(step > 0 ? std::floor(at.column) + 1.0 : std::ceil(at.column) - 1.0);
  const auto column = [&] { return static_cast<int>(wrapped(step > 0 ? meridian - 1 : meridian, width)); };
  for (; step > 0 ? meridian < end.column : meridian > end.column; meridian += step) {
    const glm::dvec2& normal = normals_[wrapped(meridian, width)];
    const double along = -glm::dot(normal, glm::dvec2(from)) / glm::dot(normal, glm::dvec2(way));
    const glm::dvec3 crossing = glm::normalize(from + std::clamp(std::isfinite(along) ? along : 0.5, 0.0, 1.0) * way);
    const OutlinePoint next = {crossing, static_cast<double>(meridian), sums_.position_of(crossing.z)};
    add_piece(column(), at, next, max_splits, sum);
    at = next;
  }
  add_piece(column(), at, end, max_splits, sum);
  sum.turn += turn;
}

glm::dvec4 PolygonFilter::light(const glm::dvec3& direction, const glm::dvec3& along_x,
                                const glm::dvec3& along_y) const {
  const double reach = 0.5 * std::max(glm::length(along_x + along_y), glm::length(along_x - along_y));
  if (!(reach < widest_corner)) {
    return mean();
  }
  const glm::dvec3 middle = map_from_sky_ * glm::normalize(direction);
  glm::dvec3 right = map_from_sky_ * along_x;
  glm::dvec3 down = map_from_sky_ * along_y;
  widen(middle, min_width * pi / sums_.height(), right, down);
  const std::array<glm::dvec3, 4> corners = {moved(middle, -0.5 * (right + down)), moved(middle, 0.5 * (right - down)),
                                             moved(middle, 0.5 * (right + down)), moved(middle, 0.5 * (down - right))};
  const double longer = std::max(glm::length(right), glm::length(down));
  Sum sum;
  sum.tolerance = 8.0 * part_off * glm::length(glm::cross(right, down)) / longer;
  for (std::size_t i = 0; i < 4; ++i) {
    add_side(corners[i], corners[(i + 1) % 4], sum);
  }
  // For an outline around the lower pole, the sum is the light outside the outline, which is
  // subtracted from that of the sky.
  if (std::abs(sum.turn) > 0.5 * sums_.width() && middle.z < 0.0) {
    const double sign = sum.turn > 0.0 ? 1.0 : -1.0;
    sum.light = sums_.whole() - sign * sum.light;
    sum.area = 2.0 * sums_.width() - sign * sum.area;
  }
  return sum.light / sum.area;
}

glm::dvec4 PolygonFilter::mean() const { return sums_.whole() / (2.0 * sums_.width()); }

void PolygonFilter::filter(const LensPixels& lens, int count, float* rgba) const {
  static WorkCounter counter("filter_polygons");
  const WorkScope work(counter, count);
  parallel_for(count, 256, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      glm::dvec4 seen(0.0);
      if (lens.coverage[i] > 0.0F) {
        seen = light(vector_at(lens.sky, i), vector_at(lens.sky_along_x, i), vector_at(lens.sky_along_y, i));
      }
      for (int part = 0; part < 4; ++part) {
        // Rounding must not make light negative. The fourth number may be (CubeMap).
        rgba[4 * static_cast<long>(i) + part] = static_cast<float>(part < 3 ? std::max(seen[part], 0.0) : seen[part]);
      }
    }
  });
}

}  // namespace ergodome
