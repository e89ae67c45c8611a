#include "render/patterns/test_pattern.h"

#include <fmt/format.h>

#include <algorithm>

#include "kernels/core/error.h"
#include "render/patterns/orientation_pattern.h"
#include "render/patterns/patterns.h"

namespace ergodome {

const std::vector<std::string>& test_pattern_names() {
  static const std::vector<std::string> names = {"orientation", "polar_grid",  "checker",    "grey_ramp", "colour_bars",
                                                 "resolution",  "blend_check", "left_right", "white",     "black"};
  return names;
}

TestPattern test_pattern(const std::string& name) {
  const auto& names = test_pattern_names();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) {
    throw Error(name, "is not a test pattern", fmt::format("choose one of {}", fmt::join(names, ", ")));
  }
  return static_cast<TestPattern>(found - names.begin());
}

Picture draw_test_pattern(TestPattern pattern, const PatternView& projection, FramePart eye) {
  switch (pattern) {
    case TestPattern::polar_grid:
      return polar_grid_pattern(projection);
    case TestPattern::checker:
      return checker_pattern(projection);
    case TestPattern::grey_ramp:
      return grey_ramp_pattern(projection);
    case TestPattern::colour_bars:
      return colour_bar_pattern(projection);
    case TestPattern::resolution:
      return resolution_pattern(projection);
    case TestPattern::blend_check:
      return blend_check_pattern(projection);
    case TestPattern::left_right:
      return left_right_pattern(projection, eye != FramePart::right, eye != FramePart::left);
    case TestPattern::white:
      return even_pattern(projection, 1.0F);
    case TestPattern::black:
      return even_pattern(projection, 0.0F);
    case TestPattern::orientation:
      break;
  }
  return orientation_pattern(projection);
}

}  // namespace ergodome
