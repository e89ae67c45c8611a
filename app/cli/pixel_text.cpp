#include "app/cli/pixel_text.h"

#include "app/cli/usage_error.h"
#include "kernels/core/error.h"

namespace ergodome {

double pixels_of(const std::string& option, const std::string& text) {
  std::size_t used = 0;
  double value = 0.0;
  try {
    value = std::stod(text, &used);
  } catch (const std::exception&) {
    used = 0;
  }
  const std::string unit = text.substr(used);
  if (used == 0 || !(unit.empty() || unit == "px") || !(value >= 1e-4 && value <= 100.0)) {
    throw UsageError(option + " " + text, "is not a number of pixels",
                     "write for example " + option + " 0.1px, from 1e-4 to 100");
  }
  return value;
}

}  // namespace ergodome
