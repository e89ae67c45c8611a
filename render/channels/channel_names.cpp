#include "render/channels/channel_names.h"

#include <fmt/format.h>

#include <algorithm>

#include "kernels/core/error.h"

namespace ergodome {

namespace {

constexpr const char* mass_length = "GM/c**2";
constexpr const char* mass_time = "GM/c**3";

std::string listed_groups() { return fmt::format("{}", fmt::join(channel_group_names(), ", ")); }

}  // namespace

const std::vector<std::string>& channel_group_names() {
  static const std::vector<std::string> names = {"g",     "magnification", "order",     "sky",    "equatorial",
                                                 "disk",  "disk.0",        "disk.1",    "disk.2", "mino_time",
                                                 "steps", "error",         "direction", "color"};
  return names;
}

std::vector<ChannelMeaning> channels_of(ChannelGroup group) {
  switch (group) {
    case ChannelGroup::g:
      return {{"g", "", "received / emitted frequency, sky at rest"}};
    case ChannelGroup::magnification:
      return {{"magnification", "", "solid angle in view / on sky, with parity"}};
    case ChannelGroup::order:
      return {{"order.image", "", "whole half turns around the hole"},
              {"order.half_turns", "", "angle swept around the hole / pi"}};
    case ChannelGroup::sky:
      return {{"sky.longitude", "deg", "azimuth around the spin axis"},
              {"sky.latitude", "deg", "angle above the hole's equator"}};
    case ChannelGroup::equatorial:
      return {{"equatorial.ra", "deg", "right ascension, J2000"}, {"equatorial.dec", "deg", "declination, J2000"}};
    case ChannelGroup::disk:
      return {{"disk.radius", mass_length, "Boyer-Lindquist r at the disk"},
              {"disk.azimuth", "deg", "Boyer-Lindquist phi at the disk"},
              {"disk.g", "", "received / emitted frequency, disk matter"},
              {"disk.delay", mass_time, "coordinate time, disk to camera"},
              {"disk.order", "", "earlier crossings of the equatorial plane"}};
    case ChannelGroup::disk_0:
      return {{"disk.0.radius", mass_length, "r at crossing 0 of the disk plane"},
              {"disk.0.azimuth", "deg", "phi at crossing 0"},
              {"disk.0.g", "", "received / emitted frequency, crossing 0"},
              {"disk.0.delay", mass_time, "coordinate time, crossing 0 to camera"}};
    case ChannelGroup::disk_1:
      return {{"disk.1.radius", mass_length, "r at crossing 1 of the disk plane"},
              {"disk.1.azimuth", "deg", "phi at crossing 1"},
              {"disk.1.g", "", "received / emitted frequency, crossing 1"},
              {"disk.1.delay", mass_time, "coordinate time, crossing 1 to camera"}};
    case ChannelGroup::disk_2:
      return {{"disk.2.radius", mass_length, "r at crossing 2 of the disk plane"},
              {"disk.2.azimuth", "deg", "phi at crossing 2"},
              {"disk.2.g", "", "received / emitted frequency, crossing 2"},
              {"disk.2.delay", mass_time, "coordinate time, crossing 2 to camera"}};
    case ChannelGroup::mino_time:
      return {{"mino_time", "c**2/GM", "Mino time from the sky, for E = 1"}};
    case ChannelGroup::steps:
      return {{"steps", "", "integration steps of the ray"}};
    case ChannelGroup::error:
      return {{"error", "rad", "integrator's error estimate"}};
    case ChannelGroup::direction:
      return {{"direction.r", "", "component of the view direction along e_r"},
              {"direction.theta", "", "component of the view direction along e_theta"},
              {"direction.phi", "", "component of the view direction along e_phi"}};
    case ChannelGroup::color:
      return {{"color.R", "", "linear light, Rec. 709 red"},
              {"color.G", "", "linear light, Rec. 709 green"},
              {"color.B", "", "linear light, Rec. 709 blue"}};
  }
  return {};
}

std::vector<ChannelGroup> channel_groups(const std::string& list) {
  const std::vector<std::string>& names = channel_group_names();
  std::vector<ChannelGroup> groups;
  for (std::size_t begin = 0; begin <= list.size();) {
    const std::size_t end = std::min(list.find(',', begin), list.size());
    const std::string word = list.substr(begin, end - begin);
    const auto found = std::ranges::find(names, word);
    if (found == names.end()) {
      throw Error("--channels", fmt::format("\"{}\" is not a channel", word), "choose from " + listed_groups());
    }
    const auto group = static_cast<ChannelGroup>(found - names.begin());
    if (std::ranges::find(groups, group) != groups.end()) {
      throw Error("--channels", fmt::format("\"{}\" names {} twice", list, word), "name it once");
    }
    groups.push_back(group);
    begin = end + 1;
  }
  return groups;
}

}  // namespace ergodome
