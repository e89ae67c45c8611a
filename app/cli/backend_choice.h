#pragma once

#include <string>

#include "kernels/launch/launch.h"

namespace CLI {
class App;
}

namespace ergodome {

//! Begins the group "Computation" of a command with --backend.
void add_backend_option(CLI::App& command, std::string& backend);

//! Returns the backend for "auto", "cpu" or "cuda". Without a usable GPU, `auto` selects the CPU
//! and prints a note once; "cuda" throws Error.
Backend choose_backend(const std::string& word);

//! Describes a backend: "cpu (avx512, 2 threads)" or "cuda".
std::string describe(Backend backend);

//! Throws UsageError if ERGODOME_INSTRUCTION_SET or ERGODOME_THREADS has an invalid value, or one
//! that this CPU does not support. An empty value counts as not set.
void check_environment();

}  // namespace ergodome
