#pragma once

#include <vector>

#include "content/show/show.h"
#include "render/channels/channel_files.h"

namespace ergodome {

//! The parameters that a frame of channels carries. `show`: with its numbers as they are in that frame; frames count from 0.
std::vector<ChannelFact> channel_facts(const Show& show, int frame, const ChannelScene& scene);

}  // namespace ergodome
