#include <algorithm>

#include "app/remote/osc/osc_handler.h"
#include "content/files/printable.h"

namespace ergodome {

namespace {

constexpr std::size_t longest_text = 200;

const std::string prefix = "/ergodome/status/";

float as_float(double value) { return static_cast<float>(value); }

//! Returns a shortened text without zero bytes, which end OSC strings.
std::string within_a_packet(const std::string& text) {
  const std::string_view part = shortened(text, longest_text);
  return {part.begin(), std::find(part.begin(), part.end(), '\0')};
}

std::string chapter_title(const PlayerStatus& status) {
  const auto index = static_cast<std::size_t>(status.chapter);
  return status.chapter >= 0 && index < status.chapters.size() ? status.chapters[index].title : "";
}

}  // namespace

std::vector<OscOutput> osc_status(const PlayerStatus& status) {
  const auto pads = static_cast<std::int32_t>(std::min<std::size_t>(status.pads.size(), 1000));
  return {{prefix + "title", {within_a_packet(status.title)}},
          {prefix + "time", {as_float(status.time_s)}},
          {prefix + "time_exact", {OscDouble{status.time_s}}},
          {prefix + "duration", {as_float(status.duration_s)}},
          {prefix + "playing", {status.playing}},
          {prefix + "speed", {as_float(status.speed)}},
          {prefix + "clock", {within_a_packet(status.clock)}},
          {prefix + "loop", {status.loop}},
          {prefix + "blackout", {status.blackout}},
          {prefix + "chapter", {OscInteger{status.chapter}, within_a_packet(chapter_title(status))}},
          {prefix + "exposure", {as_float(status.exposure_stops)}},
          {prefix + "baseline", {as_float(status.baseline)}},
          {prefix + "baseline_used", {as_float(status.baseline_used)}},
          {prefix + "volume", {as_float(status.volume)}},
          {prefix + "language", {within_a_packet(status.language)}},
          {prefix + "captions", {status.captions}},
          {prefix + "free_flight", {status.free_flight}},
          {prefix + "frame_ms", {as_float(status.frame_ms)}},
          {prefix + "dropped_frames",
           {OscInteger{static_cast<std::int32_t>(std::clamp(status.dropped_frames, 0L, 0x7FFFFFFFL))}}},
          {prefix + "pads", {OscInteger{pads}}},
          {prefix + "problem", {within_a_packet(status.problem)}}};
}

}  // namespace ergodome
