#include "app/disk_room.h"

#include <fmt/format.h>

namespace ergodome {

namespace {

std::string room_text(std::uintmax_t bytes) {
  constexpr double mib = 1024.0 * 1024.0;
  const double size_mib = static_cast<double>(bytes) / mib;
  return size_mib < 1000.0 ? fmt::format("{:.3g} MiB", size_mib) : fmt::format("{:.1f} GiB", size_mib / 1024.0);
}

}  // namespace

std::string room_note(const std::string& folder, std::uintmax_t taken_bytes, std::uintmax_t left_bytes) {
  if (taken_bytes <= left_bytes) {
    return "";
  }
  return fmt::format(
      "{}: the rest of the run takes about {}, and its disk has {} left; free some, or go on elsewhere with "
      "--frames",
      folder, room_text(taken_bytes), room_text(left_bytes));
}

}  // namespace ergodome
