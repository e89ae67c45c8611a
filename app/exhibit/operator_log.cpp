#include "app/exhibit/operator_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "app/remote/common/command_rules.h"

namespace ergodome {

namespace {

//! A command is logged once it has not been repeated for this time.
constexpr double quiet_s = 1.0;
//! A command that keeps being repeated is logged this long after it first came.
constexpr double longest_wait_of_line_s = 5.0;

std::string argument_text(const CommandRule& rule, const TransportCommand& command) {
  switch (rule.argument) {
    case Argument::none:
      return "";
    case Argument::flag:
      return command.value != 0.0 ? " on" : " off";
    case Argument::language_tag:
      return " " + command.text;
    default:
      return fmt::format(" {:.6g}", command.value);
  }
}

std::string line_of_change(const TransportCommand& command, int count) {
  const auto rules = command_rules();
  const auto rule = std::ranges::find(rules, command.kind, &CommandRule::kind);
  const std::string what =
      rule == rules.end() ? "an unknown command" : std::string(rule->name) + argument_text(*rule, command);
  return fmt::format("operator: {} (from {}{})", what, command.source,
                     count > 1 ? fmt::format(", {} times", count) : "");
}

}  // namespace

void OperatorLog::note(const std::vector<TransportCommand>& commands, double now_s) {
  for (const TransportCommand& command : commands) {
    if (command.source.empty()) {
      continue;
    }
    const auto same = std::ranges::find_if(waiting_, [&](const Waiting& each) {
      return each.command.kind == command.kind && each.command.source == command.source;
    });
    if (same != waiting_.end()) {
      same->command = command;
      ++same->count;
      same->last_s = now_s;
      continue;
    }
    if (waiting_.size() >= max_waiting) {
      ready_.push_back(line_of_change(waiting_.front().command, waiting_.front().count));
      waiting_.erase(waiting_.begin());
    }
    waiting_.push_back({command, 1, now_s, now_s});
  }
}

std::vector<std::string> OperatorLog::take(double now_s) {
  std::erase_if(waiting_, [&](const Waiting& each) {
    const bool is_ready = now_s - each.last_s >= quiet_s || now_s - each.first_s >= longest_wait_of_line_s;
    if (is_ready) {
      ready_.push_back(line_of_change(each.command, each.count));
    }
    return is_ready;
  });
  return std::exchange(ready_, {});
}

std::vector<std::string> OperatorLog::take_all() { return take(1e300); }

}  // namespace ergodome
