#include "app/navigation/controls/help_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <vector>

#include "app/navigation/controls/help_layout.h"

namespace ergodome {

namespace {

//! Removes keys from the front of a list and returns them: as many as fit in a column, at least
//! one.
std::string taken_from(std::string& keys) {
  constexpr std::size_t room = 26;  // bytes; names of keys are short
  std::size_t end = keys.size() <= room ? keys.size() : keys.rfind(", ", room);
  end = end == std::string::npos ? std::min(keys.find(", "), keys.size()) : end;
  std::string taken = keys.substr(0, end);
  keys.erase(0, std::min(end + 2, keys.size()));
  return keys.empty() ? taken : taken + ",";
}

//! Subjects by which the help groups its lines, in order.
enum class HelpGroup { flight, camera, picture, show, stereo, program };

struct GroupName {
  const char* english;
  const char* german;
};
constexpr std::array group_names = {GroupName{"Flight", "Flug"},   GroupName{"Camera", "Kamera"},
                                    GroupName{"Picture", "Bild"},  GroupName{"Show", "Vorführung"},
                                    GroupName{"Stereo", "Stereo"}, GroupName{"Program", "Programm"}};

//! A line of the help: one action, or two that belong together.
struct HelpRow {
  HelpGroup group;
  std::array<KeyAction, 2> actions;  //!< the second may be KeyAction::none
  const char* english = nullptr;     //!< null: the action's own description
  const char* german = nullptr;
};

std::span<const HelpRow> help_rows() {
  using enum KeyAction;
  using enum HelpGroup;
  static constexpr std::array rows = {
      HelpRow{flight, {fly, none}},
      HelpRow{flight, {return_to_path, none}},
      HelpRow{flight, {reset, none}},
      HelpRow{flight, {next_flight_mode, none}, "orbit, ship, hover, free fall", "Umlauf, Schiff, Schweben, Fall"},
      HelpRow{flight, {reverse_orbit, none}},
      HelpRow{flight, {let_go, none}},
      HelpRow{flight, {next_observer, none}},
      HelpRow{picture, {exposure_down, exposure_up}, "half a stop darker, brighter", "halbe Blende dunkler, heller"},
      HelpRow{picture, {exposure_reset, none}},
      HelpRow{picture, {blackout, none}},
      HelpRow{picture, {full_screen, none}},
      HelpRow{picture, {next_view, none}, "next view: sky, heat maps", "nächste Ansicht: Himmel, Karten"},
      HelpRow{picture, {times, none}, "frame time and lens", "Bildzeit und Linse"},
      HelpRow{show, {pause, none}},
      HelpRow{show, {seek_back, seek_forward}, "2 s back, forward", "2 s zurück, vor"},
      HelpRow{show, {previous_chapter, next_chapter}, "previous, next chapter", "voriges, nächstes Kapitel"},
      HelpRow{show, {step_back, step_forward}, "one frame back, forward", "ein Bild zurück, vor"},
      HelpRow{show, {slower, faster}, "half, double the speed", "halb, doppelt so schnell"},
      HelpRow{show, {usual_speed, none}},
      HelpRow{show, {reverse, none}},
      HelpRow{show, {restart, none}, "to the start of the show", "an den Anfang"},
      HelpRow{show, {loop, none}},
      HelpRow{show, {captions, none}},
      HelpRow{show, {next_language, none}},
      HelpRow{show, {volume_down, volume_up}, "quieter, louder", "leiser, lauter"},
      HelpRow{show, {reload, none}, "reload the show file", "Vorführung neu laden"},
      HelpRow{stereo, {baseline_smaller, baseline_larger}, "smaller, larger baseline", "Stereobasis kleiner, größer"},
      HelpRow{stereo, {baseline_reset, none}},
      HelpRow{
          stereo, {convergence_nearer, convergence_farther}, "converge nearer, farther", "Konvergenz näher, ferner"},
      HelpRow{stereo, {swap_eyes, none}},
      HelpRow{stereo, {tint_eyes, none}, "tint the eyes red, cyan", "Augen rot, cyan färben"},
      HelpRow{stereo, {next_layout, none}},
      HelpRow{stereo, {next_model, none}, "next stereo model", "nächstes Stereo-Modell"},
      HelpRow{program, {help, none}},
      HelpRow{program, {quit, none}},
  };
  return rows;
}

//! Returns the subject of a steering component: `flight` if it moves the camera, otherwise
//! `camera`.
HelpGroup group_of(const SteerNames& named) {
  const auto moves = {&Steering::right, &Steering::up, &Steering::forward, &Steering::faster};
  return std::ranges::find(moves, named.component) != moves.end() ? HelpGroup::flight : HelpGroup::camera;
}

const ActionNames& summary_of(KeyAction action) {
  return *std::ranges::find(all_actions(), action, &ActionNames::action);
}

//! Cells of a line: keys and mouse, controller, description.
using HelpLine = std::array<std::string, 3>;

class HelpLines {
 public:
  explicit HelpLines(const HelpChoice& choice) : choice_(choice) {}

  //! Starts a subject, to which the lines that are added next belong.
  void begin_group(const char* english, const char* german) {
    groups_.push_back({choice_.language == "de" ? german : english, {}});
  }

  void begin(const char* english, const char* german) { line_ = {"", "", choice_.language == "de" ? german : english}; }

  void add(const Input& input) {
    const bool of_pad = input.kind == Input::Kind::pad_button || input.kind == Input::Kind::pad_axis;
    // 3D mice and paddles are omitted for lack of space.
    const bool puck = input.kind == Input::Kind::pad_axis && input.code >= static_cast<int>(PadAxis::move_right);
    const bool paddle = input.kind == Input::Kind::pad_button && input.code >= static_cast<int>(PadButton::capture);
    if (puck || paddle || (of_pad && !choice_.pads)) {
      return;
    }
    std::string& cell = line_[of_pad ? 1 : 0];
    cell += cell.empty() ? "" : ", ";
    const std::string label = label_of(input, choice_.language);
    // The comma key is spelled out, because commas separate the keys.
    cell += label != "," ? label : choice_.language == "de" ? "Komma" : "Comma";
  }

  void end() {
    if (!line_[0].empty() || !line_[1].empty()) {
      groups_.back().lines.push_back(line_);
    }
  }

  [[nodiscard]] std::string text() const {
    switch (choice_.form) {
      case HelpForm::words:
        return in_words();
      case HelpForm::cells:
        return in_cells();
      default:
        return in_columns(in_cells(), 1);
    }
  }

 private:
  [[nodiscard]] std::string in_words() const {
    std::string text;
    for (const Group& group : groups_) {
      for (const HelpLine& line : group.lines) {
        const std::string& inputs = line[choice_.pads ? 1 : 0];
        if (!inputs.empty()) {
          text.append(inputs).append(": ").append(line[2]).append("\n");
        }
      }
    }
    return text;
  }

  //! Returns the lines of all subjects as cells separated by tabs: name of the subject, then its
  //! lines; empty lines between subjects. Keys that do not fit in their cell continue on lines
  //! below.
  [[nodiscard]] std::string in_cells() const {
    std::string text;
    for (const Group& group : groups_) {
      if (group.lines.empty()) {
        continue;
      }
      text += (text.empty() ? "" : "\n") + group.name + "\n";
      for (const HelpLine& line : group.lines) {
        std::string keys = line[0];
        text += fmt::format("  {}\t{}\t{}\n", taken_from(keys), line[1], line[2]);
        while (!keys.empty()) {
          text += "  " + taken_from(keys) + "\n";
        }
      }
    }
    return text;
  }

  struct Group {
    std::string name;
    std::vector<HelpLine> lines;
  };
  HelpChoice choice_;
  HelpLine line_;
  std::vector<Group> groups_;
};

//! Adds one line for several actions.
void add_actions(HelpLines& lines, const Controls& controls, std::span<const KeyAction> actions, const char* english,
                 const char* german) {
  lines.begin(english, german);
  for (const KeyAction action : actions) {
    for (const Input& input : controls.inputs_of(action)) {
      lines.add(input);
    }
  }
  lines.end();
}

//! Adds a row: one line with its common description, or one line per action if it has none or if
//! one of its actions has no input.
void add_row(HelpLines& lines, const Controls& controls, const HelpRow& row) {
  const bool bound = std::ranges::all_of(
      row.actions, [&](KeyAction action) { return action == KeyAction::none || !controls.inputs_of(action).empty(); });
  if (row.english != nullptr && bound) {
    add_actions(lines, controls, row.actions, row.english, row.german);
    return;
  }
  for (const KeyAction action : row.actions) {
    if (action != KeyAction::none) {
      add_actions(lines, controls, {&action, 1}, summary_of(action).english, summary_of(action).german);
    }
  }
}

void add_steering(HelpLines& lines, const Controls& controls, HelpGroup group) {
  for (const SteerNames& named : all_steering()) {
    if (group_of(named) == group) {
      lines.begin(named.english, named.german);
      for (const Controls::SteerBinding& binding : controls.inputs_of(named.component)) {
        lines.add(binding.input);
      }
      lines.end();
    }
  }
}

}  // namespace

std::string help_text(const Controls& controls, const HelpChoice& choice) {
  HelpLines lines(choice);
  for (std::size_t i = 0; i < group_names.size(); ++i) {
    const auto group = static_cast<HelpGroup>(i);
    lines.begin_group(group_names[i].english, group_names[i].german);
    add_steering(lines, controls, group);
    for (const HelpRow& row : help_rows()) {
      const bool may_use =
          choice.reader == ActionUser::presenter || summary_of(row.actions.front()).user == ActionUser::visitor;
      if (row.group == group && may_use) {
        add_row(lines, controls, row);
      }
    }
  }
  return lines.text();
}

}  // namespace ergodome
