#pragma once

#include "kernels/core/error.h"

namespace ergodome {

//! A command line that makes no sense, by itself or for the show that it names: the program ends with status 2, as for what the parser refuses. Its remedy
//! changes the command line, not a file.
class UsageError : public Error {
 public:
  using Error::Error;
};

}  // namespace ergodome
