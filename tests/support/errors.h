#pragma once

#include <string>

#include "kernels/core/error.h"

namespace ergodome::test {

//! Returns the message of the Error that an action throws, or an empty string if it throws none.
template <class Action>
std::string error_of(const Action& action) {
  try {
    action();
  } catch (const Error& problem) {
    return problem.what();
  }
  return "";
}

}  // namespace ergodome::test
