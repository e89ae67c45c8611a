#pragma once

#include <string>

#include "kernels/launch/launch.h"

namespace ergodome {

//! The backend for "auto", "cpu" or "cuda". `auto` without a usable GPU says so once on standard error and takes the CPU; "cuda"
//! without one is an Error.
Backend choose_backend(const std::string& word);

//! What works, for people: "cpu (avx512, 2 threads)" or "cuda".
std::string describe(Backend backend);

}  // namespace ergodome
