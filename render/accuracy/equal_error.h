#pragma once

#include "render/accuracy/measurement.h"

// Compares methods at the same error.

namespace ergodome {

//! Which time counts as cost.
enum class FrameCost {
  ready,  //!< a frame whose prepared data exist
  anew    //!< a frame including the preparation
};

//! Returns the median time of a choice [ms].
double cost_ms(const Measurement& choice, FrameCost cost);

//! Returns the cheapest choice whose error is at most `most` for 99 % (p99), among those of
//! `method`, or of all methods if it is empty; nullptr if there is none.
const Measurement* cheapest_within(const AccuracyAxis& axis, double most, FrameCost cost,
                                   const std::string& method = {});

//! A method at an error limit that applies to all methods.
struct EqualErrorRow {
  std::string method;
  //! Its cheapest choice within the limit; nullptr: none that was measured.
  const Measurement* choice = nullptr;
  //! Of its time to that of the base method, by round; without a base it has no runs.
  Spread ratio;
};

//! Compares the methods of an axis at the same error (p99), in the order of the axis; each with its
//! cheapest precision and setting.
std::vector<EqualErrorRow> compare_at(const AccuracyAxis& axis, double most, FrameCost cost);

}  // namespace ergodome
