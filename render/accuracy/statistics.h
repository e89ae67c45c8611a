#pragma once

#include <cstddef>
#include <vector>

namespace ergodome {

//! What a set of errors looks like. A NaN counts as an infinite error, so that nothing that went wrong looks right.
struct ErrorSummary {
  std::size_t count = 0;
  double median = 0.0;
  double p99 = 0.0;   //!< all but one in a hundred are no greater
  double p999 = 0.0;  //!< all but one in a thousand
  double largest = 0.0;
};

//! Several runs of one piece of work.
struct Spread {
  double median = 0.0;
  double least = 0.0;
  double greatest = 0.0;
  int runs = 0;
};

//! The value that a share of the values (0 to 1) does not exceed: nearest rank, of sorted values; 0 of none.
double quantile(const std::vector<double>& sorted, double share);

//! Summary of errors, which are not negative, in any order.
ErrorSummary summary_of(std::vector<double> errors);

//! Middle and ends of runs, in any order. With an even number of runs the middle is the mean of the middle two.
Spread spread_of(std::vector<double> runs);

//! Ratios of one piece of work's runs to another's that were timed in the same rounds; as many as both have.
Spread ratio_of(const std::vector<double>& runs, const std::vector<double>& other);

//! Which of a number of choices are worth their cost: no other is as good in both cost and error, and better in one. Choices whose cost or
//! error is not finite never are. Throws nothing; both have one value a choice.
std::vector<bool> pareto_front(const std::vector<double>& cost, const std::vector<double>& error);

}  // namespace ergodome
