#pragma once

#include <vector>

#include "content/show/show.h"
#include "render/channels/channel_files.h"

namespace ergodome {

//! Returns the parameters stored in a frame of channels. `show` must be evaluated at the time of
//! the frame; frames count from 0.
std::vector<MetadataEntry> channel_metadata(const Show& show, int frame, const ChannelScene& scene);

}  // namespace ergodome
