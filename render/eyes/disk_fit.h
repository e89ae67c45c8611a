#pragma once

#include <functional>
#include <vector>

// Least-squares fit of polynomials of two variables (p, q) on the unit disk. Order of terms: 1, p,
// q, p², p q, q², ...
namespace ergodome {

//! A point on the unit disk.
struct DiskPoint {
  double p;
  double q;
};

//! Returns the center of the unit disk and `rings` rings of `spokes` points each, denser towards
//! the rim. Every second ring is rotated by half the angle between spokes. `turn` rotates all
//! points, in units of that angle.
std::vector<DiskPoint> disk_points(int rings, int spokes, double turn);

//! Returns the values at a point of all terms up to a degree.
std::vector<double> disk_terms(const DiskPoint& point, int degree);

//! Fits many sets of values at the same points. There must be more points than terms, in general
//! position.
class DiskFit {
 public:
  DiskFit(const std::vector<DiskPoint>& points, int degree);

  //! Returns the coefficients of the polynomial that fits the values at the points with the
  //! smallest sum of squared errors.
  [[nodiscard]] std::vector<double> fit(std::vector<double> values) const;

 private:
  //! Orthonormalized terms: one vector of values at the points for each term.
  std::vector<std::vector<double>> columns_;
  //! Triangular matrix that transforms coefficients of `columns_` to coefficients of the terms.
  std::vector<std::vector<double>> triangle_;
};

//! Function that returns values at a point on the disk, equally many for every point.
using DiskNumbers = std::function<std::vector<double>(const DiskPoint& point)>;

//! Fits one polynomial of a degree to each of the values that `numbers_at` returns, and returns the
//! coefficients of all polynomials one after the other.
std::vector<double> fit_numbers(const DiskNumbers& numbers_at, int degree);

}  // namespace ergodome
