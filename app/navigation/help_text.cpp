#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "app/navigation/controls.h"
#include "app/navigation/help_layout.h"

namespace ergodome {

namespace {

//! Takes keys from the front of a list of them, as many as a column has room for; at least one.
std::string taken_from(std::string& keys) {
  constexpr std::size_t room = 34;  // bytes: names of keys are short
  std::size_t end = keys.size() <= room ? keys.size() : keys.rfind(", ", room);
  end = end == std::string::npos ? std::min(keys.find(", "), keys.size()) : end;
  std::string taken = keys.substr(0, end);
  keys.erase(0, std::min(end + 2, keys.size()));
  return keys.empty() ? taken : taken + ",";
}

//! A line: keys and mouse, pad, what they do.
using HelpLine = std::array<std::string, 3>;

class HelpLines {
 public:
  explicit HelpLines(const HelpChoice& choice) : choice_(choice) {}

  void begin(const char* english, const char* german) { line_ = {"", "", choice_.language == "de" ? german : english}; }

  void add(const Input& input) {
    const bool of_pad = input.kind == Input::Kind::pad_button || input.kind == Input::Kind::pad_axis;
    // Pucks and paddles are known to those who have them; there is no room for all.
    const bool puck = input.kind == Input::Kind::pad_axis && input.code >= static_cast<int>(PadAxis::move_right);
    const bool paddle = input.kind == Input::Kind::pad_button && input.code >= static_cast<int>(PadButton::capture);
    if (puck || paddle || (of_pad && !choice_.pads)) {
      return;
    }
    std::string& cell = line_[of_pad ? 1 : 0];
    cell += cell.empty() ? "" : ", ";
    cell += label_of(input, choice_.language);
  }

  void end() {
    if (!line_[0].empty() || !line_[1].empty()) {
      lines_.push_back(line_);
    }
  }

  [[nodiscard]] std::string text() const {
    switch (choice_.form) {
      case HelpForm::words:
        return in_words();
      case HelpForm::cells:
        return in_cells();
      default:
        return in_blocks(in_cells(), 1);
    }
  }

 private:
  [[nodiscard]] std::string in_words() const {
    std::string text;
    for (const HelpLine& line : lines_) {
      const std::string& inputs = line[choice_.pads ? 1 : 0];
      if (!inputs.empty()) {
        text.append(inputs).append(": ").append(line[2]).append("\n");
      }
    }
    return text;
  }

  [[nodiscard]] std::string in_cells() const {
    std::string text;
    for (const HelpLine& line : lines_) {
      std::string keys = line[0];
      text += fmt::format("{}\t{}\t{}\n", taken_from(keys), line[1], line[2]);
      while (!keys.empty()) {
        text += taken_from(keys) + "\n";
      }
    }
    return text;
  }

  HelpChoice choice_;
  HelpLine line_;
  std::vector<HelpLine> lines_;
};

}  // namespace

std::string Controls::help_text(const HelpChoice& choice) const {
  HelpLines lines(choice);
  for (const SteerFacts& facts : all_steering()) {
    lines.begin(facts.english, facts.german);
    for (const SteerBinding& binding : inputs_of(facts.component)) {
      lines.add(binding.input);
    }
    lines.end();
  }
  for (const ActionFacts& facts : all_actions()) {
    // Who shows an exhibit learns from its page how to leave it; elsewhere there is none to leave.
    const bool presenters = facts.user == ActionUser::presenter && facts.action != KeyAction::leave_exhibit;
    if (facts.user == ActionUser::visitor || (presenters && choice.reader == ActionUser::presenter)) {
      lines.begin(facts.english, facts.german);
      for (const Input& input : inputs_of(facts.action)) {
        lines.add(input);
      }
      lines.end();
    }
  }
  return lines.text();
}

}  // namespace ergodome
