#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace ergodome {

//! Numbers that are asked for together, by one word.
enum class ChannelGroup : std::int32_t {
  g,
  magnification,
  order,
  sky,
  equatorial,
  disk,
  disk_0,
  disk_1,
  disk_2,
  mino_time,
  steps,
  error,
  direction,
  color
};

//! What one channel holds. Lengths and times are in units of the hole's mass.
struct ChannelMeaning {
  const char* name;     //!< in EXR and FITS files
  const char* unit;     //!< as FITS spells it (BUNIT); empty for pure numbers and light
  const char* meaning;  //!< short enough for the comment of a FITS keyword
};

//! The words for ChannelGroup, in its order.
const std::vector<std::string>& channel_group_names();

//! Whether a group needs a disk in the show.
constexpr bool is_of_disk(ChannelGroup group) { return group >= ChannelGroup::disk && group <= ChannelGroup::disk_2; }

//! The channels of a group, in the order in which they are written.
std::vector<ChannelMeaning> channels_of(ChannelGroup group);

//! Parses a list of words separated by commas. Throws Error for an unknown word, one that is given twice, and an empty list.
std::vector<ChannelGroup> channel_groups(const std::string& list);

}  // namespace ergodome
