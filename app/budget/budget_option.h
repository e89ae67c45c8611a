#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace ergodome {

//! Adds --budget to a command: words for parse_budget(). The option may be given twice, with one
//! word each.
void add_budget_option(CLI::App& command, std::vector<std::string>& words);

}  // namespace ergodome
