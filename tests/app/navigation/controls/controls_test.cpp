#include "app/navigation/controls/controls.h"

#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "app/navigation/controls/help_text.h"
#include "tests/support/errors.h"
#include "tests/support/folder_test.h"

namespace ergodome {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

std::string error_of(const std::string& text) {
  return test::error_of([&] { parse_controls(text, "c.toml"); });
}

PadState pad_with(PadButton button) {
  PadState pad;
  pad.buttons.set(static_cast<std::size_t>(button));
  return pad;
}

PadState pad_with(PadAxis axis, float value) {
  PadState pad;
  pad.axes[static_cast<std::size_t>(axis)] = value;
  return pad;
}

bool of_keyboard(const Input& input) { return input.kind == Input::Kind::key; }
bool of_pad(const Input& input) { return input.kind == Input::Kind::pad_button || input.kind == Input::Kind::pad_axis; }

//! Returns the first indented block of a Markdown page.
std::string first_block_of(const std::string& page) {
  std::ifstream stream(page);
  std::string block;
  for (std::string line; std::getline(stream, line);) {
    const bool within = line.starts_with("    ") || (line.empty() && !block.empty());
    if (!within && !block.empty()) {
      break;
    }
    block += within ? line + "\n" : "";
  }
  return block;
}

TEST(Controls, TheirPagesExampleIsRead) {
  const std::string example = first_block_of(ERGODOME_SOURCE_DIR "/content/docs/reference/controls.md");
  EXPECT_THAT(example, HasSubstr("[steer]"));
  EXPECT_EQ(error_of(example), "");
}

TEST(Controls, EveryActionHasAKeyAndThoseOfVisitorsAPadsButton) {
  const Controls controls;
  for (const ActionNames& named : all_actions()) {
    const auto& inputs = controls.inputs_of(named.action);
    EXPECT_TRUE(std::ranges::any_of(inputs, of_keyboard)) << named.name;
    EXPECT_TRUE(named.user == ActionUser::presenter || std::ranges::any_of(inputs, of_pad)) << named.name;
  }
}

TEST(Controls, EveryWayToSteerHasKeysAndAPad) {
  const Controls controls;
  for (const SteerNames& named : all_steering()) {
    const auto& bindings = controls.inputs_of(named.component);
    const auto with = [&](auto kind) {
      return std::ranges::any_of(bindings, [&](const Controls::SteerBinding& b) { return kind(b.input); });
    };
    EXPECT_TRUE(with(of_keyboard)) << named.name;
    EXPECT_TRUE(with(of_pad)) << named.name;
  }
}

TEST(Controls, EveryActionHasFacts) {
  for (int action = 1; action <= static_cast<int>(KeyAction::leave_exhibit); ++action) {
    EXPECT_TRUE(std::ranges::any_of(all_actions(), [&](const ActionNames& named) {
      return named.action == static_cast<KeyAction>(action);
    })) << action;
  }
}

TEST(Controls, TheProgramsMapBindsNothingTwice) { EXPECT_EQ(error_of(to_toml(Controls())), ""); }

TEST(Controls, ComeBackFromTheirFile) {
  const std::string text = to_toml(Controls());
  EXPECT_EQ(to_toml(parse_controls(text, "c.toml")), text);
  const Controls own = parse_controls(
      "[actions]\npause = \"Ctrl+Alt+P\"\nquit = []\n[steer]\nright = [\"0.5*pad.right_x\", \"-K\"]\n", "c.toml");
  EXPECT_EQ(to_toml(parse_controls(to_toml(own), "again.toml")), to_toml(own));
  EXPECT_THAT(to_toml(own), HasSubstr("right = [\"0.5*pad.right_x\", \"-K\"]"));
}

TEST(Controls, EveryInputComesBackFromItsName) {
  for (const std::string& name : input_names()) {
    ASSERT_TRUE(input_of(name).has_value()) << name;
    EXPECT_EQ(name_of(*input_of(name)), name);
  }
  EXPECT_EQ(name_of(*input_of("Shift+Ctrl+Q")), "Ctrl+Shift+Q");
  EXPECT_FALSE(input_of("Ctrl+pad.south").has_value());
  EXPECT_FALSE(input_of("").has_value());
}

TEST(Controls, KeysActWithTheirModifiersAlone) {
  const Controls controls;
  EXPECT_THAT(controls.pressed(GLFW_KEY_LEFT, {GLFW_KEY_LEFT}), ElementsAre(KeyAction::seek_back));
  EXPECT_THAT(controls.pressed(GLFW_KEY_LEFT, {GLFW_KEY_RIGHT_CONTROL, GLFW_KEY_LEFT}),
              ElementsAre(KeyAction::step_back));
  EXPECT_THAT(controls.pressed(GLFW_KEY_LEFT, {GLFW_KEY_LEFT_SHIFT, GLFW_KEY_LEFT}), IsEmpty());
  EXPECT_THAT(controls.pressed(GLFW_KEY_SPACE, {}), ElementsAre(KeyAction::pause));
}

TEST(Controls, HeldKeysSteerWithShiftAndNotWithCtrl) {
  const Controls controls;
  const auto steering = [&](const std::set<int>& held) { return controls.steering(held, {}, {}).rates; };
  EXPECT_EQ(steering({GLFW_KEY_W, GLFW_KEY_A}), (Steering{-1.0, 0.0, 1.0}));
  EXPECT_EQ(steering({GLFW_KEY_W, GLFW_KEY_LEFT_SHIFT}), (Steering{0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0}));
  EXPECT_EQ(steering({GLFW_KEY_R, GLFW_KEY_LEFT_CONTROL}), Steering{});
  EXPECT_EQ(steering({GLFW_KEY_LEFT, GLFW_KEY_LEFT_SHIFT}).yaw, -1.0);
  EXPECT_EQ(steering({GLFW_KEY_LEFT}), Steering{});
}

TEST(Controls, SticksAndKeysAddUpToOneAtTheMost) {
  const Controls controls;
  EXPECT_NEAR(controls.steering({}, {}, pad_with(PadAxis::left_x, -0.25F)).rates.right, -0.25, 1e-7);
  EXPECT_EQ(controls.steering({GLFW_KEY_D}, {}, pad_with(PadAxis::left_x, 0.5F)).rates.right, 1.0);
  EXPECT_EQ(controls.steering({}, {}, pad_with(PadButton::left_shoulder)).rates.up, -1.0);
}

TEST(Controls, AMouseThatIsDraggedTakesTheSkyWithIt) {
  MouseState mouse;
  mouse.right_px = 10.0;
  mouse.down_px = 5.0;
  mouse.wheel_steps = 2.0;
  mouse.radians_per_px = 0.01;
  const SteeringInput input = Controls().steering({}, mouse, {});
  EXPECT_NEAR(input.amounts.yaw, -0.1, 1e-15);
  EXPECT_NEAR(input.amounts.pitch, 0.05, 1e-15);
  EXPECT_EQ(input.amounts.zoom, 2.0);
  EXPECT_EQ(input.rates, Steering{});
}

TEST(Controls, PadButtonsActWhenTheyGoDown) {
  const Controls controls;
  const PadState down = pad_with(PadButton::start);
  EXPECT_THAT(controls.pressed(PadState{}, down), ElementsAre(KeyAction::pause));
  EXPECT_THAT(controls.pressed(down, down), IsEmpty());
  EXPECT_THAT(controls.pressed(down, PadState{}), IsEmpty());
}

TEST(Controls, WheelsAndMouseButtonsCanAct) {
  const Controls controls =
      parse_controls("[actions]\nnext_view = \"mouse.middle\"\nvolume_up = \"wheel.up\"\n", "c.toml");
  EXPECT_THAT(controls.mouse_pressed(2), ElementsAre(KeyAction::next_view));
  EXPECT_THAT(controls.wheel_turned(2.0), ElementsAre(KeyAction::volume_up, KeyAction::volume_up));
  EXPECT_THAT(controls.wheel_turned(-1.0), IsEmpty());
  EXPECT_THAT(controls.wheel_turned(std::nan("")), IsEmpty());
}

TEST(Controls, AFileTakesItsInputsFromWhatItDoesNotName) {
  const Controls controls = parse_controls("[actions]\nquit = \"W\"\n", "c.toml");
  EXPECT_THAT(controls.pressed(GLFW_KEY_W, {}), ElementsAre(KeyAction::quit));
  EXPECT_EQ(controls.steering({GLFW_KEY_W}, {}, {}).rates, Steering{});
  EXPECT_EQ(controls.steering({GLFW_KEY_S}, {}, {}).rates.forward, -1.0);
  EXPECT_THAT(controls.pressed(GLFW_KEY_ESCAPE, {}), IsEmpty());
}

TEST(Controls, SaysWhereAFileIsWrongAndWhatWasMeant) {
  EXPECT_THAT(error_of("[actions]\npaus = \"Space\"\n"),
              HasSubstr("c.toml:2: actions.paus is not a known key; did you mean \"pause\"?"));
  EXPECT_THAT(error_of("[actions]\npause = [\"Spce\"]\n"),
              HasSubstr("c.toml:2: actions.pause contains \"Spce\", which is not an input; did you mean \"Space\"?"));
  EXPECT_THAT(error_of("[steer]\n\nright = [\"-pad.left_z\"]\n"),
              HasSubstr("c.toml:3: steer.right contains \"-pad.left_z\""));
  EXPECT_THAT(error_of("[actions]\npause = \"J\"\nloop = \"J\"\n"),
              HasSubstr("binds J, which is already bound to actions."));
  EXPECT_THAT(error_of("[actions]\npause = \"J\"\n[steer]\nup = [\"-J\"]\n"),
              HasSubstr("c.toml:4: steer.up binds J, which is already bound to actions.pause"));
  EXPECT_THAT(error_of("[actions]\npause = \"Shift+J\"\n[steer]\nup = \"J\"\n"),
              HasSubstr("which is already bound to actions.pause"));
  EXPECT_THAT(error_of("[actions]\npause = \"pad.left_x\"\n"), HasSubstr("an axis, which cannot trigger an action"));
  EXPECT_THAT(error_of("[steer]\nup = [\"1e9*J\"]\n"), HasSubstr("cannot be used here; only [steer] accepts"));
  EXPECT_THAT(error_of("[steer]\nup = 3\n"), HasSubstr("is not a list of inputs"));
  EXPECT_THAT(error_of("[steering]\nup = \"J\"\n"), HasSubstr("did you mean \"steer\"?"));
  EXPECT_THAT(error_of("[actions\n"), HasSubstr("c.toml:1"));
}

TEST(ControlsHelp, ShowsWhatIsBoundNow) {
  const Controls own = parse_controls("[actions]\npause = [\"J\", \"pad.east\"]\nquit = []\n", "c.toml");
  const std::string help = help_text(own, {});
  EXPECT_THAT(help, testing::ContainsRegex("J +B / Circle +pause, resume\n"));
  EXPECT_THAT(help, Not(HasSubstr("quit")));
  EXPECT_THAT(help_text(own, {.pads = false}), Not(HasSubstr("Circle")));
}

TEST(ControlsHelp, ManyKeysOfOneActionTakeSeveralLines) {
  const Controls own =
      parse_controls("[actions]\npause = [\"Shift+Ctrl+J\", \"Shift+Ctrl+K\", \"Shift+Ctrl+L\"]\n", "c.toml");
  EXPECT_THAT(help_text(own, {.pads = false}),
              testing::ContainsRegex("\n[^\n]*Shift[^\n]*, [^\n]*, +pause, resume\n[^\n,]*Shift[^\n,]*\n"));
}

TEST(ControlsHelp, GroupsLinesBySubject) {
  const std::string help = help_text(Controls(), {.pads = false});
  std::vector<std::size_t> positions;
  for (const char* line :
       {"Flight\n", "\n\nCamera\n", "\n\nPicture\n", "\n\nShow\n", "\n\nStereo\n", "\n\nProgram\n"}) {
    positions.push_back(help.find(line));
    EXPECT_NE(positions.back(), std::string::npos) << line;
  }
  EXPECT_TRUE(std::ranges::is_sorted(positions));
  EXPECT_THAT(help, testing::ContainsRegex("\n  W, S +move forward, back\n"));
  EXPECT_THAT(help, testing::ContainsRegex("\n  Left, Right +2 s back, forward\n"));
  // Visitors cannot change stereo settings, so the help text for them does not name these settings.
  EXPECT_THAT(help_text(Controls(), {.reader = ActionUser::visitor}), Not(HasSubstr("Stereo")));
}

TEST(ControlsHelp, HasEveryActionOfAPresenterOnce) {
  for (const ActionNames& named : all_actions()) {
    if (named.action == KeyAction::leave_exhibit) {
      continue;
    }
    const Controls own = parse_controls(fmt::format("[actions]\n{} = [\"Keypad9\"]\n", named.name), "c.toml");
    const std::string help = help_text(own, {.pads = false});
    const std::size_t first = help.find("Keypad 9");
    EXPECT_NE(first, std::string::npos) << named.name;
    EXPECT_EQ(help.find("Keypad 9", first + 1), std::string::npos) << named.name;
  }
}

TEST(ControlsHelp, TellsOfOneOfTwoActionsWhereTheOtherHasNoKey) {
  const Controls own = parse_controls("[actions]\nvolume_down = []\n", "c.toml");
  EXPECT_THAT(help_text(own, {.pads = false}), testing::ContainsRegex("\n  F7 +louder\n"));
  EXPECT_THAT(help_text(own, {.pads = false}), Not(HasSubstr("quieter")));
}

TEST(ControlsHelp, LeavesOutForVisitorsWhatIsThePresenters) {
  const std::string help = help_text(Controls(), {.reader = ActionUser::visitor});
  EXPECT_THAT(help, HasSubstr("next observer"));
  EXPECT_THAT(help, Not(HasSubstr("leave the exhibit")));
}

TEST(Controls, HelpInWordsTellsOfThePadAloneWhereThereIsOne) {
  const std::string with = help_text(Controls(), {.reader = ActionUser::visitor, .form = HelpForm::words});
  EXPECT_THAT(with, HasSubstr(": this help\n"));
  EXPECT_THAT(with, Not(HasSubstr("F1")));
  EXPECT_THAT(with, Not(HasSubstr("  ")));
  EXPECT_THAT(help_text(Controls(), {.pads = false, .form = HelpForm::words}), HasSubstr("F1: this help\n"));
}

TEST(ControlsHelp, HasTheSameLinesInBothLanguages) {
  const std::string german = help_text(Controls(), {.language = "de"});
  for (const char* key : {"Leertaste", "Umschalt+", "Strg+", "Pos1", "Kreuz"}) {
    EXPECT_THAT(german, HasSubstr(key));
  }
  for (const char* key : {"Space", "Shift", "Ctrl", "Home", "mouse", "stick up", "wheel"}) {
    EXPECT_THAT(german, Not(HasSubstr(key)));
  }
  // The names of keys differ in length between languages and may take more lines, so tabs between
  // cells are counted instead of lines.
  const auto lines_of = [](std::string_view language) {
    const std::string cells = help_text(Controls(), {.language = language, .form = HelpForm::cells});
    return std::ranges::count(cells, '\t');
  };
  EXPECT_EQ(lines_of("en"), lines_of("de"));
  EXPECT_THAT(german, HasSubstr("anhalten, weiter"));
}

TEST(TransportKeys, ComeFromActionsAndWhatIsRunning) {
  PlayerStatus status;
  status.speed = 2.0;
  status.free_flight = true;
  status.exposure_stops = 1.0;
  using Kind = TransportCommand::Kind;
  EXPECT_EQ(transport_command(KeyAction::slower, status), (TransportCommand{Kind::speed, 1.0, {}}));
  EXPECT_EQ(transport_command(KeyAction::reverse, status), (TransportCommand{Kind::speed, -2.0, {}}));
  EXPECT_EQ(transport_command(KeyAction::fly, status), (TransportCommand{Kind::return_to_path, 0.0, {}}));
  EXPECT_EQ(transport_command(KeyAction::exposure_down, status), (TransportCommand{Kind::exposure, 0.5, {}}));
  EXPECT_EQ(transport_command(KeyAction::help, status), std::nullopt);
}

TEST(TransportKeys, NeverTurnSlowerIntoFaster) {
  PlayerStatus status;
  const auto after = [&](KeyAction action, double speed) {
    status.speed = speed;
    return transport_command(action, status)->value;
  };
  EXPECT_EQ(after(KeyAction::slower, 0.001), 0.001);
  EXPECT_EQ(after(KeyAction::faster, 0.001), 0.002);
  EXPECT_EQ(after(KeyAction::faster, 100.0), 100.0);
  EXPECT_EQ(after(KeyAction::slower, -100.0), -50.0);
  EXPECT_EQ(after(KeyAction::slower, 0.0625), 0.0625);
  EXPECT_EQ(after(KeyAction::faster, 0.0), 0.0625);
}

class ControlsFile : public test::FolderTest {};

TEST_F(ControlsFile, IsWrittenOnceAndReadFromTheUsersFolder) {
  const std::filesystem::path path = folder_ / "ergodome" / "controls.toml";
  std::filesystem::create_directories(path.parent_path());
  write_default_controls(path);
  EXPECT_THAT(test::error_of([&] { write_default_controls(path); }), HasSubstr("already exists"));
  EXPECT_EQ(to_toml(load_controls(path)), to_toml(Controls()));
  EXPECT_THAT(test::error_of([&] { load_controls(folder_ / "none.toml"); }), HasSubstr("none.toml"));
}

}  // namespace
}  // namespace ergodome
