#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "app/navigation/controls/actions.h"
#include "content/show/show.h"
#include "render/stereo/eye_disparity.h"

namespace ergodome {

//! Returns the stereo settings after a key; `shown` are those of the show, `r` is the camera's
//! radius [M]. Other keys change nothing.
//!
//! Baseline and convergence change in geometric steps of 25 %. The baseline ranges from r / 10,000,
//! below which it is 0, to 100 r; the convergence from r / 100 to 1,000 r, then infinity. From 0,
//! the baseline starts at r / 100; from infinity, the convergence at 3 r. Layouts cycle through
//! those for windows with one buffer. KeyAction::baseline_reset restores all settings of the show.
StereoSettings adjusted(const StereoSettings& stereo, KeyAction action, const StereoSettings& shown, double r);

//! Returns the settings as one line: layout, model, baseline, convergence, swapped. In German for
//! "de", otherwise in English.
std::string describe(const StereoSettings& stereo, std::string_view language = "en");

//! Returns the settings and their effect on a viewer's eyes: minimum and maximum horizontal
//! disparity [px and arcmin], and a warning if their difference exceeds `stereo.comfort_deg`.
std::string disparity_caption(const StereoSettings& stereo, const std::optional<Disparity>& disparity,
                              std::string_view language = "en");

}  // namespace ergodome
