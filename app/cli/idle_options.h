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

//! Options of a command that change nothing where another option's value, or the kind of a file, leaves them no use. Where it is enough that another is given
//! at all, CLI::Option::needs and excludes say the same.
class IdleOptions {
 public:
  //! `command` outlives this.
  explicit IdleOptions(CLI::App& command) : command_(&command) {}

  //! While `holds`, which is asked once the command line is read, these change nothing `where`: "without --method grid", "of a test pattern".
  void add(const char* where, std::function<bool()> holds, std::initializer_list<const char*> options);
  //! Throws CLI::ValidationError for the first that is given and changes nothing: such a command line was meant otherwise.
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
