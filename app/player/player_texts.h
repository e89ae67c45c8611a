#pragma once

#include <string>

#include "app/player/player_session.h"
#include "app/player/renderers/picture_flow.h"
#include "content/timeline/timeline.h"

namespace ergodome {

//! Frame time, size, lens and backend of the last picture; in stereo what its eyes see, too.
std::string times_text(const PictureReport& report, const StereoSettings& stereo, const std::string& backend,
                       const std::string& language);

//! A window's title: the show, the hole, where the camera is, and what the last picture took.
std::string title_text(const PictureReport& report, const PlayerSession& session, const std::string& backend);

//! A help that is to be read on a dome, where no text lies over a window.
Caption help_caption(const std::string& help);

}  // namespace ergodome
