#pragma once

#include <functional>
#include <vector>

// Least-squares fit of polynomials of two variables on the unit disk. Order of terms: 1, p, q, p²,
// p q, q², ...
namespace ergodome {

//! A point on the unit disk.
struct DiskPoint {
  double p;
  double q;
};

//! Returns the middle and `rings` rings of `spokes` points each, denser towards the rim. Every
//! other ring is turned by half a spoke; `turn` turns all points, in spokes.
std::vector<DiskPoint> disk_points(int rings, int spokes, double turn);

//! Returns the terms of polynomials of a degree at a point.
std::vector<double> disk_terms(const DiskPoint& point, int degree);

//! Fits many sets of values at the same points. There must be more points than terms, in general
//! position.
class DiskFit {
 public:
  DiskFit(const std::vector<DiskPoint>& points, int degree);

  //! Returns the coefficients of the polynomial nearest to the values.
  [[nodiscard]] std::vector<double> fit(std::vector<double> values) const;

 private:
  std::vector<std::vector<double>> columns_;   //!< orthonormal, one number per point
  std::vector<std::vector<double>> triangle_;  //!< transforms them back to the terms
};

//! A fixed number of values at a point on the disk.
using DiskNumbers = std::function<std::vector<double>(const DiskPoint& point)>;

//! Fits polynomials of a degree to all values and returns them one after the other.
std::vector<double> fit_numbers(const DiskNumbers& numbers_at, int degree);

}  // namespace ergodome
