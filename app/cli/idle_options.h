#pragma once

#include <functional>
#include <initializer_list>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace ergodome {

//! Options of a command that have no effect, given the value of another option or the kind of a
//! file. If it only matters whether another option is given, use CLI::Option::needs and excludes.
class IdleOptions {
 public:
  //! `command` must outlive this.
  explicit IdleOptions(CLI::App& command) : command_(&command) {}

  //! Registers options that have no effect while `holds` returns true; it is called after parsing.
  //! `where` is part of the message: "without --method grid", "of a test pattern".
  void add(const char* where, std::function<bool()> holds, std::initializer_list<const char*> options);
  //! Throws CLI::ValidationError for the first given option that has no effect.
  void refuse() const;

 private:
  struct Rule {
    std::string where;
    std::function<bool()> holds;
    std::vector<const CLI::Option*> options;
  };
  CLI::App* command_;
  std::vector<Rule> rules_;
};

}  // namespace ergodome
