#pragma once

#include <optional>
#include <string>

#include "app/frame_writer.h"
#include "calibration/dome_setup.h"
#include "content/show.h"

namespace ergodome {

//! A fingerprint of all that a run's frames are made by, which each of them carries: the show, the setup and the options as they were asked for, what the
//! files that they name hold, and the program's version. Where it is computed, and where frames are put, makes no difference.
std::string frame_request(const RenderOptions& options, const Show& show, const std::optional<DomeSetup>& setup);

}  // namespace ergodome
