#include "content/mesh/formats/polygon_triangles.h"

#include <cmath>
#include <numeric>

namespace ergodome {

namespace {

using Triangle = std::array<std::uint32_t, 3>;

struct Point {
  double x, y;
};

//! Returns Newell's normal: the sum of the projected areas, robust for nonplanar faces.
Vector3<double> normal_of(std::span<const Vector3<double>> corners) {
  Vector3<double> sum = {0.0, 0.0, 0.0};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vector3<double>& a = corners[i];
    const Vector3<double>& b = corners[(i + 1) % corners.size()];
    sum = sum + Vector3<double>{(a.y - b.y) * (a.z + b.z), (a.z - b.z) * (a.x + b.x), (a.x - b.x) * (a.y + b.y)};
  }
  return sum;
}

//! Projects the corners onto the coordinate plane in which the face is largest, counterclockwise.
std::vector<Point> flattened(std::span<const Vector3<double>> corners) {
  const Vector3<double> normal = normal_of(corners);
  const double x = std::abs(normal.x);
  const double y = std::abs(normal.y);
  const double z = std::abs(normal.z);
  std::vector<Point> points;
  points.reserve(corners.size());
  for (const Vector3<double>& p : corners) {
    if (z >= x && z >= y) {
      points.push_back({normal.z < 0.0 ? -p.x : p.x, p.y});
    } else if (y >= x) {
      points.push_back({normal.y < 0.0 ? -p.z : p.z, p.x});
    } else {
      points.push_back({normal.x < 0.0 ? -p.y : p.y, p.z});
    }
  }
  return points;
}

//! Returns twice the signed area of a triangle; positive if it runs counterclockwise.
double area(const Point& a, const Point& b, const Point& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool is_inside(const Point& p, const Point& a, const Point& b, const Point& c) {
  return area(a, b, p) >= 0.0 && area(b, c, p) >= 0.0 && area(c, a, p) >= 0.0;
}

bool is_same(const Point& a, const Point& b) { return a.x == b.x && a.y == b.y; }

//! Returns true if the corner left[at] is an ear, which can be cut off: the corner is convex, and
//! no other corner lies in the triangle that it forms with its neighbors.
bool is_ear(const std::vector<Point>& points, const std::vector<std::uint32_t>& left, std::size_t at) {
  const std::size_t before = (at + left.size() - 1) % left.size();
  const std::size_t after = (at + 1) % left.size();
  const Point& a = points[left[before]];
  const Point& b = points[left[at]];
  const Point& c = points[left[after]];
  if (area(a, b, c) <= 0.0) {
    return false;
  }
  for (std::size_t i = 0; i < left.size(); ++i) {
    const Point& p = points[left[i]];
    const bool own = i == before || i == at || i == after || is_same(p, a) || is_same(p, b) || is_same(p, c);
    if (!own && is_inside(p, a, b, c)) {
      return false;
    }
  }
  return true;
}

std::vector<Triangle> ears_of(const std::vector<Point>& points) {
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> left(points.size());
  std::iota(left.begin(), left.end(), 0U);
  std::size_t at = 0;
  std::size_t tried = 0;
  while (left.size() > 3) {
    // A face in which no ear is found intersects itself or has no area. Then the current corner is
    // cut off, whatever its shape.
    if (tried < left.size() && !is_ear(points, left, at)) {
      at = (at + 1) % left.size();
      ++tried;
      continue;
    }
    triangles.push_back({left[(at + left.size() - 1) % left.size()], left[at], left[(at + 1) % left.size()]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(at));
    at %= left.size();
    tried = 0;
  }
  triangles.push_back({left[0], left[1], left[2]});
  return triangles;
}

}  // namespace

std::vector<Triangle> triangles_of_polygon(std::span<const Vector3<double>> corners) {
  if (corners.size() == 3) {
    return {{0, 1, 2}};
  }
  const std::vector<Point> points = flattened(corners);
  if (corners.size() == 4) {
    const bool first = area(points[0], points[1], points[2]) > 0.0 && area(points[0], points[2], points[3]) > 0.0;
    const bool second = area(points[0], points[1], points[3]) > 0.0 && area(points[1], points[2], points[3]) > 0.0;
    const auto square = [](const Vector3<double>& d) { return dot(d, d); };
    if (first && (!second || square(corners[2] - corners[0]) <= square(corners[3] - corners[1]))) {
      return {{0, 1, 2}, {0, 2, 3}};
    }
    if (second) {
      return {{0, 1, 3}, {1, 2, 3}};
    }
  }
  return ears_of(points);
}

}  // namespace ergodome
