#pragma once

#include <functional>
#include <initializer_list>
#include <span>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
class Validator;
}  // namespace CLI

namespace ergodome {

//! Parses a number of pixels, "0.1px" or "0.1", from 1e-4 to 100. Throws UsageError, naming the
//! option, for other text.
double pixels_of(const std::string& option, const std::string& text);

//! Returns a check for an option that is one of some names.
CLI::Validator one_of(std::span<const char* const> names);

//! Returns a check for an option with a number from `minimum` to `maximum`. Unlike CLI::Range, it
//! rejects "nan" and prints the limits in full.
CLI::Validator number_between(double minimum, double maximum);

//! Returns a check for an option with a frame rate, as a number or as a fraction ("30000/1001").
//! Converts it to a number, which is exact if it is an abbreviation of 1000/1001 of an integer
//! rate. For transform(), because check() cannot change the value.
CLI::Validator frame_rate_between(double minimum, double maximum);

//! Returns a check for show times [s]: any number from -1e12 to 1e12.
CLI::Validator show_time();

//! Options of a command that have no effect, given the value of another option or the kind of a
//! file. If it only matters whether another option is given, use CLI::Option::needs and excludes.
class IgnoredOptions {
 public:
  //! `command` must outlive this.
  explicit IgnoredOptions(CLI::App& command) : command_(&command) {}

  //! Registers options that have no effect while `holds` returns true; `holds` is called after
  //! parsing. `where` is part of the message: "without --method grid", "of a test pattern".
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
