#pragma once

#include <cstdint>
#include <string>
#include <vector>

// Names, units and descriptions of channels.

namespace ergodome {

//! Groups of channels; each has one name and is requested as a whole.
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

//! Description of a channel. Lengths and times are in units of the hole's mass.
struct ChannelMeaning {
  const char* name;     //!< name of the channel in EXR and FITS files
  const char* unit;     //!< unit in FITS spelling (BUNIT); empty for pure numbers and light
  const char* meaning;  //!< description, short enough for the comment of a FITS keyword
};

//! Returns the names of ChannelGroup, in its order.
const std::vector<std::string>& channel_group_names();

//! Returns whether a group requires a disk in the show.
constexpr bool is_of_disk(ChannelGroup group) { return group >= ChannelGroup::disk && group <= ChannelGroup::disk_2; }

//! Returns the channels of a group, in the order in which they are written.
std::vector<ChannelMeaning> channels_of(ChannelGroup group);

//! Parses a comma-separated list of names. Throws Error for an unknown or repeated name, and for an
//! empty list.
std::vector<ChannelGroup> channel_groups(const std::string& list);

}  // namespace ergodome
