#pragma once

#include <filesystem>
#include <string>

#include "app/cluster/cluster_messages.h"
#include "app/player/renderers/frame_source.h"

namespace ergodome {

//! Returns the frame that lets another computer render a request. `rate`: change of show time per
//! second.
ClusterFrame cluster_frame(const PictureRequest& request, double rate);

//! Changes a request so that it renders the picture of a frame, but with its own renderer. Pictures
//! wait for their lens, so that all computers show the same one.
void apply(const ClusterFrame& frame, PictureRequest& request);

//! Returns the fingerprint of a show with the changes of the command line.
std::string show_fingerprint(const Show& show);

//! Returns the fingerprint of the contents of all files that a show names. Of files above a
//! gibibyte, only the first one and the size count.
std::string content_fingerprint(const Show& show);

}  // namespace ergodome
