#include "app/player/eye_notice.h"

#include <fmt/format.h>

namespace ergodome {

std::string line_of(const NarrowedEyes& eyes, const std::string& language) {
  return language == "de"
             ? fmt::format("Augen {:.3g} M auseinander passen hier nicht: Sie stehen so weit, wie es geht.", eyes.asked)
             : fmt::format("Eyes {:.3g} M apart do not fit here: they stand as far apart as they can.", eyes.asked);
}

std::string note_of(const Show& show, double time_s, const NarrowedEyes& eyes, const std::optional<double>& chosen) {
  if (!chosen) {
    return note_of(show, time_s, eyes);
  }
  Show without_line = show;
  without_line.lines.clear();
  without_line.name.clear();
  return note_of(without_line, time_s, eyes);
}

}  // namespace ergodome
