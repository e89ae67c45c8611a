#pragma once

#include "render/accuracy/measurement.h"

namespace ergodome {

//! What counts as time.
enum class FrameCost {
  ready,  //!< a frame when what it needs is there
  anew    //!< with what it needs made anew
};

//! Median time of a choice [ms].
double cost_ms(const Measurement& choice, FrameCost cost);

//! The cheapest choice whose error does not exceed `most` for 99 of 100 (p99); of one method, or of all where `method` is empty. nullptr where
//! none does.
const Measurement* cheapest_within(const AccuracyAxis& axis, double most, FrameCost cost,
                                   const std::string& method = {});

//! A method at an error that all are held to.
struct EqualErrorRow {
  std::string method;
  const Measurement* choice = nullptr;  //!< its cheapest that holds it; nullptr: none of those that were measured does
  Spread ratio;                         //!< of its time to that of the base, by round; no runs where there is no base
};

//! The methods of an axis at one error (p99), in the order of the axis; each in the precision and setting that is cheapest there.
std::vector<EqualErrorRow> compare_at(const AccuracyAxis& axis, double most, FrameCost cost);

}  // namespace ergodome
