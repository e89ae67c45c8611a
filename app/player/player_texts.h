#pragma once

#include <string>

#include "app/player/player_session.h"
#include "app/player/renderers/picture_flow.h"
#include "content/timeline/timeline.h"

namespace ergodome {

//! Returns frame time, size, lens and backend of the last picture, and for stereo the disparity.
std::string times_text(const PictureReport& report, const StereoSettings& stereo, const std::string& backend,
                       const std::string& language);

//! Returns the window's title: the show, the spin, the camera's radius, the show time, and frame
//! time, size, lens and backend of the last picture.
std::string title_text(const PictureReport& report, const PlayerSession& session, const std::string& backend);

//! Returns the help as a caption for a dome, where no text can be laid over a window.
Caption help_caption(const std::string& help);

}  // namespace ergodome
