#pragma once

namespace ergodome {

//! The program, from its command line to its exit status: 2 for a command line that makes no sense, 1 for what went wrong, which is told
//! on the standard error.
int run_program(int argc, char** argv);

}  // namespace ergodome
