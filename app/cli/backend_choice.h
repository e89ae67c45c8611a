#pragma once

#include <string>

#include "kernels/launch/launch.h"

namespace ergodome {

//! Returns the backend for "auto", "cpu" or "cuda". Without a usable GPU, `auto` selects the CPU
//! and prints a note once; "cuda" throws Error.
Backend choose_backend(const std::string& word);

//! Describes a backend: "cpu (avx512, 2 threads)" or "cuda".
std::string describe(Backend backend);

}  // namespace ergodome
