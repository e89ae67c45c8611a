#include "render/eyes/disk_fit.h"

#include <cmath>
#include <cstddef>
#include <numeric>

#include "kernels/core/angles.h"

namespace ergodome {

namespace {

double product(const std::vector<double>& a, const std::vector<double>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

void subtract(double factor, const std::vector<double>& what, std::vector<double>& from) {
  for (std::size_t i = 0; i < from.size(); ++i) {
    from[i] -= factor * what[i];
  }
}

}  // namespace

std::vector<DiskPoint> disk_points(int rings, int spokes, double turn) {
  std::vector<DiskPoint> points;
  for (int ring = 0; ring < rings; ++ring) {
    const double radius = std::cos(0.5 * pi * ring / rings);
    for (int spoke = 0; spoke < spokes; ++spoke) {
      const double angle = 2.0 * pi * (spoke + turn + 0.5 * (ring % 2)) / spokes;
      points.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
  }
  points.push_back({0.0, 0.0});
  return points;
}

std::vector<double> disk_terms(const DiskPoint& point, int degree) {
  std::vector<double> terms;
  for (int d = 0; d <= degree; ++d) {
    for (int j = 0; j <= d; ++j) {
      terms.push_back(std::pow(point.p, d - j) * std::pow(point.q, j));
    }
  }
  return terms;
}

// Uses the modified Gram-Schmidt method: orthogonalizes the remaining part of each term against the
// earlier ones.
DiskFit::DiskFit(const std::vector<DiskPoint>& points, int degree) {
  const std::size_t terms = disk_terms({0.0, 0.0}, degree).size();
  columns_.assign(terms, std::vector<double>(points.size()));
  triangle_.assign(terms, std::vector<double>(terms));
  for (std::size_t row = 0; row < points.size(); ++row) {
    const std::vector<double> values = disk_terms(points[row], degree);
    for (std::size_t i = 0; i < terms; ++i) {
      columns_[i][row] = values[i];
    }
  }
  for (std::size_t i = 0; i < terms; ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      triangle_[k][i] = product(columns_[k], columns_[i]);
      subtract(triangle_[k][i], columns_[k], columns_[i]);
    }
    triangle_[i][i] = std::sqrt(product(columns_[i], columns_[i]));
    for (double& value : columns_[i]) {
      value /= triangle_[i][i];
    }
  }
}

std::vector<double> DiskFit::fit(std::vector<double> values) const {
  std::vector<double> coefficients(columns_.size());
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    coefficients[i] = product(columns_[i], values);
    subtract(coefficients[i], columns_[i], values);
  }
  for (std::size_t i = columns_.size(); i-- > 0;) {
    for (std::size_t k = i + 1; k < columns_.size(); ++k) {
      coefficients[i] -= triangle_[i][k] * coefficients[k];
    }
    coefficients[i] /= triangle_[i][i];
  }
  return coefficients;
}

std::vector<double> fit_numbers(const DiskNumbers& numbers_at, int degree) {
  const std::vector<DiskPoint> points = disk_points(degree + 1, 2 * degree + 3, 0.0);
  std::vector<std::vector<double>> exact;
  exact.reserve(points.size());
  for (const DiskPoint& point : points) {
    exact.push_back(numbers_at(point));
  }
  const DiskFit squares(points, degree);
  std::vector<double> coefficients;
  for (std::size_t i = 0; i < exact.front().size(); ++i) {
    std::vector<double> values;
    values.reserve(exact.size());
    for (const std::vector<double>& numbers : exact) {
      values.push_back(numbers[i]);
    }
    const std::vector<double> own = squares.fit(std::move(values));
    coefficients.insert(coefficients.end(), own.begin(), own.end());
  }
  return coefficients;
}

}  // namespace ergodome
