#pragma once

#include <chrono>
#include <cstddef>
#include <vector>

// Statistics of errors and times, and the clock for the latter.

namespace ergodome {

//! Measures the wall-clock time since its creation.
class Stopwatch {
 public:
  [[nodiscard]] double elapsed_ms() const {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin_).count();
  }

 private:
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

//! Summary of a set of errors. NaN counts as an infinite error, so that failures never look
//! accurate.
struct ErrorSummary {
  std::size_t count = 0;
  double median = 0.0;
  double p99 = 0.0;   //!< 99 % of the errors are at most this
  double p999 = 0.0;  //!< 99.9 % of the errors are at most this
  double largest = 0.0;
};

//! Median and extremes of several runs of the same work.
struct Spread {
  double median = 0.0;
  double minimum = 0.0;
  double maximum = 0.0;
  int runs = 0;
};

//! Returns the quantile of sorted values at `share` (0 to 1), by nearest rank; 0 if there are no
//! values.
double quantile(const std::vector<double>& sorted, double share);

//! Summarizes errors, which must not be negative, in any order.
ErrorSummary summary_of(std::vector<double> errors);

//! Returns median and extremes of runs, in any order. The median of an even number of runs is the
//! mean of the middle two.
Spread spread_of(std::vector<double> runs);

//! Returns the spread of the ratios `runs` / `other` between the times of two methods, formed round
//! by round; uses as many rounds as both have.
Spread ratio_of(const std::vector<double>& runs, const std::vector<double>& other);

//! Returns for each entry whether it is on the Pareto front: no other entry is at least as good in
//! both cost and error, and better in one. Entries with a non-finite cost or error are never on it.
//! Both vectors have one value per entry.
std::vector<bool> pareto_front(const std::vector<double>& cost, const std::vector<double>& error);

}  // namespace ergodome
