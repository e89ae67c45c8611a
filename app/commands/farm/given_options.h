#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace ergodome {

//! Returns the options that were given to a command as words for another command line,
//! "--size=512", in the order of their registration. Leaves out the named options and arguments
//! without a name.
std::vector<std::string> given_options(const CLI::App& command, const std::vector<std::string>& left_out);

}  // namespace ergodome
