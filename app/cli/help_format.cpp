#include "app/cli/help_format.h"

#include <fmt/format.h>

#include <cstdio>
#include <initializer_list>
#include <sstream>
#include <utility>
#include <vector>

namespace ergodome {

namespace {

constexpr std::size_t name_columns = 30;
constexpr std::size_t text_columns = 120 - name_columns;

//! Wraps the description of an option into lines that fit beside the column of names.
std::string wrapped(const std::string& text) {
  std::istringstream words(text);
  std::string lines;
  std::size_t used = 0;
  for (std::string word; words >> word; used += word.size()) {
    if (used > 0) {
      const bool fits = used + 1 + word.size() <= text_columns;
      lines += fits ? ' ' : '\n';
      used = fits ? used + 1 : 0;
    }
    lines += word;
  }
  return lines;
}

//! Returns the choices "{a,b,c}" of an option's type as "a, b, c"; empty if it has none, or if its
//! description `text` contains all of them.
std::string choices_of(const std::string& type, const std::string& text) {
  const std::size_t from = type.find('{');
  if (from == std::string::npos) {
    return "";
  }
  std::istringstream list(type.substr(from + 1, type.find('}', from) - from - 1));
  std::string choices;
  bool listed = true;
  for (std::string choice; std::getline(list, choice, ',');) {
    choices += (choices.empty() ? "" : ", ") + choice;
    listed = listed && text.find(choice) != std::string::npos;
  }
  return listed ? "" : choices;
}

//! Returns the range "[a - b]" of an option's type as "a to b"; empty if it has none or is
//! practically unlimited.
std::string range_of_type(const std::string& type) {
  constexpr double practically_unlimited = 1e6;
  const std::size_t from = type.find('[');
  double minimum = 0.0;
  double maximum = 0.0;
  if (from == std::string::npos || std::sscanf(type.c_str() + from, "[%lf - %lf]", &minimum, &maximum) != 2 ||
      maximum >= practically_unlimited) {
    return "";
  }
  return fmt::format("{:g} to {:g}", minimum, maximum);
}

}  // namespace

HelpFormat::HelpFormat() {
  column_width(name_columns);
  label("Positionals", "Arguments");
  label("SUBCOMMAND", "COMMAND");
}

std::string HelpFormat::make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const {
  return CLI::detail::find_and_replace(CLI::Formatter::make_help(app, std::move(name), mode), "\n\n\n", "\n\n");
}

std::string HelpFormat::make_subcommand(const CLI::App* command) const {
  std::ostringstream out;
  CLI::detail::format_help(out, command->get_name(), wrapped(command->get_description()), name_columns);
  return out.str();
}

std::string HelpFormat::make_option_name(const CLI::Option* option, bool is_positional) const {
  const std::string name = CLI::Formatter::make_option_name(option, is_positional);
  return name.substr(0, name.find('{'));  // without the false value of a flag
}

std::string HelpFormat::make_option_opts(const CLI::Option* option) const {
  const std::string type = option->get_type_name();
  if (option->get_type_size() == 0 || option->get_positional()) {
    return "";
  }
  const std::string name = type.substr(0, type.find(':'));
  const bool chosen = type.find('{') != std::string::npos;
  const bool number = name.starts_with("INT") || name.starts_with("UINT") || name.starts_with("FLOAT");
  return " " + (chosen ? "NAME" : number ? "N" : name);
}

std::string HelpFormat::make_option_desc(const CLI::Option* option) const {
  const std::string type = option->get_type_name();
  const std::string& described = option->get_description();
  const std::size_t end = described.ends_with(')') ? described.rfind(" (default: ") : std::string::npos;
  std::string text = described.substr(0, end);
  if (const std::string choices = choices_of(type, text); !choices.empty()) {
    text += ": " + choices;
  }
  const std::string& value = option->get_default_str();
  const std::string last = end != std::string::npos ? described.substr(end + 2, described.size() - end - 3)
                           : !value.empty()         ? "default: " + value
                           : option->get_required() && !option->get_positional() ? "required"
                                                                                 : "";
  const std::string range = range_of_type(type);
  if (!range.empty() || !last.empty()) {
    text += fmt::format(" ({}{}{})", range, range.empty() || last.empty() ? "" : "; ", last);
  }
  return wrapped(text);
}

void group_commands(CLI::App& app) {
  const std::pair<const char*, std::vector<const char*>> groups[] = {
      {"Show", {"play", "node", "render", "farm"}},
      {"Prepare", {"bake", "calibrate", "convert", "pad", "catalogue"}},
      {"Examine", {"inspect", "plan", "diagram", "accuracy"}},
      {"Compute tables", {"trace", "edge", "connect"}}};
  for (const auto& [group, commands] : groups) {
    for (const char* const command : commands) {
      app.get_subcommand(command)->group(group);
    }
  }
}

}  // namespace ergodome
