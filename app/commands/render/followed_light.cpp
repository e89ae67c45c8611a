#include "app/commands/render/followed_light.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <map>
#include <sstream>
#include <system_error>
#include <utility>

#include "content/files/atomic_file.h"
#include "content/files/whole_file.h"
#include "content/show/animated_show.h"
#include "kernels/core/error.h"
#include "render/output/tone_map.h"

namespace ergodome {

namespace {

namespace fs = std::filesystem;

constexpr const char* light_prefix = "light-";
constexpr std::size_t max_light_bytes = std::size_t{64} << 20U;

[[noreturn]] void refuse_light(const fs::path& file, int line) {
  throw Error(fmt::format("{}:{}", file.string(), line), "is not the light of a frame",
              "remove the file, and measure its frames again with --meter");
}

//! Parses "FRAME REQUEST LIGHT"; the frame is counted from 1.
FrameLight frame_light(const fs::path& file, int number, const std::string& line) {
  std::istringstream words(line);
  FrameLight light;
  std::string value;
  std::string more;
  if (!(words >> light.frame >> light.request >> value) || words >> more || light.frame < 1) {
    refuse_light(file, number);
  }
  const auto [end, problem] = std::from_chars(value.data(), value.data() + value.size(), light.light);
  if (problem != std::errc() || end != value.data() + value.size() || !std::isfinite(light.light)) {
    refuse_light(file, number);
  }
  --light.frame;
  return light;
}

//! Returns the light of all frames with their current fingerprints.
std::map<int, double> read_light(const fs::path& folder, const Show& show, const FrameRequests& requests) {
  std::map<int, double> light;
  std::error_code problem;
  for (fs::directory_iterator each(folder, problem), end; !problem && each != end; each.increment(problem)) {
    if (!each->path().filename().string().starts_with(light_prefix)) {
      continue;
    }
    std::istringstream lines(read_whole_file(each->path(), max_light_bytes, "measure the light again with --meter"));
    int number = 0;
    for (std::string line; std::getline(lines, line);) {
      const FrameLight frame = frame_light(each->path(), ++number, line);
      if (frame.request == requests.at(frame_time_s(show, frame.frame))) {
        light[frame.frame] = frame.light;
      }
    }
  }
  if (problem) {
    throw Error("--light " + folder.string(), "cannot be read: " + problem.message(),
                "measure the light first with --meter");
  }
  return light;
}

}  // namespace

void write_light(const fs::path& folder, const std::vector<FrameLight>& frames) {
  make_folder(folder);
  std::string text;
  for (const FrameLight& frame : frames) {
    text += fmt::format("{} {} {:.17g}\n", frame.frame + 1, frame.request, frame.light);
  }
  write_text_atomically(
      folder / fmt::format("{}{:06}-{:06}", light_prefix, frames.front().frame + 1, frames.back().frame + 1), text);
}

FollowedLight::FollowedLight(const fs::path& folder, Show show, const FrameRequests& requests) {
  const std::map<int, double> light = read_light(folder, show, requests);
  if (light.empty() || !show.tone.automatic) {
    return;
  }
  first_ = light.begin()->first;
  AutoExposure exposure(*show.tone.automatic);
  double last_s = 0.0;
  for (const auto& [frame, value] : light) {
    if (frame != first_ + static_cast<int>(stops_.size())) {
      break;
    }
    const double time_s = frame_time_s(show, frame);
    animate(show, time_s);
    exposure.set(*show.tone.automatic);
    stops_.push_back(exposure.follow(value, time_s - last_s));
    last_s = time_s;
  }
}

std::optional<double> FollowedLight::stops_at(int frame) const {
  const int index = frame - first_;
  return index >= 0 && index < static_cast<int>(stops_.size()) ? std::optional(stops_[static_cast<std::size_t>(index)])
                                                               : std::nullopt;
}

}  // namespace ergodome
