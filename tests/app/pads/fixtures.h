#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "app/pads/decoders/pad_decoder.h"
#include "app/pads/hid/hid_fixture.h"
#include "app/pads/pad_response.h"
#include "app/pads/state/pad_names.h"

// Recordings of pads for tests, and the values that decoders should read from them.
namespace ergodome::test {

//! Reads a recording (a "fixture") by its name, from the folder tests/data/hid.
HidFixture fixture(const std::string& name);

//! Returns a profile that does not change what a decoder reads: no dead zones, linear curves.
inline PadProfile straight_profile() {
  PadProfile profile;
  profile.left_stick = profile.right_stick = profile.triggers = profile.puck = PadCurve{};
  return profile;
}

//! The expected result of an event, parsed from the text `expect` of a fixture. It contains the
//! kind of report, buttons, and axes such as left_x=-0.5.
struct Expectation {
  PadReport kind = PadReport::state;
  PadState state;

  explicit Expectation(const std::string& text) {
    std::istringstream words(text);
    for (std::string word; words >> word;) {
      take(word);
    }
  }

 private:
  void take(const std::string& word) {
    const std::size_t equals = word.find('=');
    if (word == "refused" || word == "other" || word == "absent" || word == "changed") {
      kind = word == "refused"  ? PadReport::refused
             : word == "other"  ? PadReport::other
             : word == "absent" ? PadReport::absent
                                : PadReport::changed;
    } else if (equals != std::string::npos) {
      const auto axis = pad_axis_named(word.substr(0, equals));
      ASSERT_TRUE(axis) << word;
      state.axes[static_cast<std::size_t>(*axis)] = std::stof(word.substr(equals + 1));
    } else {
      const auto button = pad_button_named(word);
      ASSERT_TRUE(button) << word;
      state.buttons.set(static_cast<std::size_t>(*button));
    }
  }
};

//! Converts raw numbers of a device to a pad state. Unlike the program, does not limit sticks to a
//! circle, so that both axes can be at their maximum.
inline PadState read_straight(const RawLayout& layout, const RawPad& raw) {
  const PadResponse response(layout, straight_profile());
  PadState state;
  state.buttons = response.apply(raw, {}, {}).buttons;
  for (std::size_t i = 0; i < layout.axes.size(); ++i) {
    if (layout.axes[i].axis) {
      float& axis = state.axes[static_cast<std::size_t>(*layout.axes[i].axis)];
      const auto here = static_cast<float>(response.position(i, raw.values[i]));
      axis = std::abs(here) > std::abs(axis) ? here : axis;
    }
  }
  return state;
}

//! Returns the names of pressed buttons, for messages and comparisons.
inline std::vector<std::string> pressed(const PadState& state) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < pad_button_count; ++i) {
    if (state.buttons[i]) {
      names.emplace_back(name_of(static_cast<PadButton>(i)));
    }
  }
  return names;
}

}  // namespace ergodome::test
