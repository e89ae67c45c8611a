#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/cluster/cluster_messages.h"
#include "app/player/renderers/frame_source.h"

namespace ergodome {

//! Returns the frame that lets another computer render a request. `rate`: change of show time per
//! second.
ClusterFrame cluster_frame(const PictureRequest& request, double rate);

//! Changes a request so that it renders the picture of a frame, but with its own renderer. Pictures
//! wait for their lens, so that all computers show the same one.
void apply(const ClusterFrame& frame, PictureRequest& request);

//! Changes the stops of automatic exposure with which a finished picture is shown.
void show_with_stops(double stops, PictureAnswer& answer);

//! Returns captions with the texts of one language only.
std::vector<Caption> in_language(std::vector<Caption> captions, const std::string& language);

//! Returns the fingerprint of shows with the changes of the command line.
std::string fingerprint_of_shows(const std::vector<Show>& shows);

//! Returns the fingerprint of the contents of all files that shows name. Of files above a gibibyte,
//! only the first one and the size count.
std::string fingerprint_of_contents(const std::vector<Show>& shows);

}  // namespace ergodome
