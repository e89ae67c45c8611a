#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace ergodome {

//! Formats `--help`: each option with a placeholder and its meaning, then its choices or range and
//! its default.
class HelpFormat : public CLI::Formatter {
 public:
  HelpFormat();
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override;
  std::string make_subcommand(const CLI::App* command) const override;
  std::string make_option_name(const CLI::Option* option, bool is_positional) const override;
  std::string make_option_opts(const CLI::Option* option) const override;
  std::string make_option_desc(const CLI::Option* option) const override;
};

//! Sorts the commands of the program into groups for its `--help`.
void group_commands(CLI::App& app);

}  // namespace ergodome
