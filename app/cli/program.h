#pragma once

namespace ergodome {

//! Runs the program and returns its exit status: 0, 2 for an invalid command line, 1 for other
//! errors. Prints errors on stderr.
int run_program(int argc, char** argv);

}  // namespace ergodome
