#pragma once

#include "kernels/core/error.h"

namespace ergodome {

//! An invalid command line, by itself or for the show that it names. The program exits with status
//! 2, as for errors of the parser. The remedy changes the command line, not a file.
class UsageError : public Error {
 public:
  using Error::Error;
};

}  // namespace ergodome
