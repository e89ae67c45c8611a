#include "app/player/eye_notice.h"

#include <fmt/format.h>

namespace ergodome {

std::string line_of(const ReducedBaseline& eyes, const std::string& language) {
  return language == "de"
             ? fmt::format(
                   "Der Augenabstand von {:.3g} M ist hier nicht möglich; er wurde auf den größten möglichen Wert "
                   "verringert.",
                   eyes.asked)
             : fmt::format(
                   "The baseline of {:.3g} M is not possible here; it was reduced to the largest possible value.",
                   eyes.asked);
}

std::string note_of(const Show& show, double time_s, const ReducedBaseline& eyes, const std::optional<double>& chosen) {
  if (!chosen) {
    return note_of(show, time_s, eyes);
  }
  Show without_line = show;
  without_line.lines.clear();
  without_line.name.clear();
  return note_of(without_line, time_s, eyes);
}

}  // namespace ergodome
