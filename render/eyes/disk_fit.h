#pragma once

#include <functional>
#include <vector>

// Polynomials of two variables on the unit disk, fitted by least squares. Their terms come in the order 1, p, q, p², p q, q², ...
namespace ergodome {

//! A place on the unit disk.
struct DiskPoint {
  double p;
  double q;
};

//! `rings` rings of `spokes` places each, closer towards the rim, every other one turned by half a spoke, and the middle. `turn`: what all are
//! turned by, in spokes.
std::vector<DiskPoint> disk_points(int rings, int spokes, double turn);

//! The terms of polynomials of a degree at a place.
std::vector<double> disk_terms(const DiskPoint& point, int degree);

//! The fit of values at places, for many sets of values. There have to be more places than terms, in general position.
class DiskFit {
 public:
  DiskFit(const std::vector<DiskPoint>& points, int degree);

  //! Coefficients of the polynomial nearest to the values at the places.
  [[nodiscard]] std::vector<double> fit(std::vector<double> values) const;

 private:
  std::vector<std::vector<double>> columns_;   //!< orthonormal, a number for each place
  std::vector<std::vector<double>> triangle_;  //!< leads from them back to the terms
};

//! Numbers at a place on the disk, always as many.
using DiskNumbers = std::function<std::vector<double>(const DiskPoint& point)>;

//! Polynomials of a degree of all numbers, one after the other.
std::vector<double> fit_numbers(const DiskNumbers& numbers_at, int degree);

}  // namespace ergodome
