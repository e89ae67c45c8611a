#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "app/navigation/controls/actions.h"
#include "content/show/show.h"
#include "render/eyes/eye_disparity.h"

namespace ergodome {

//! What a key makes of the stereo settings; `shown` are those of the show, `r` is the camera's [M]. Keys that have nothing to do with stereo
//! change nothing.
//!
//! Baseline and convergence go in geometric steps of a quarter. The baseline goes from r / 10,000, below which it is 0, to 100 r, the convergence from
//! r / 100 to 1,000 r and then to infinity; from 0 the baseline begins at r / 100, from infinity the convergence at 3 r. Layouts are those that a window of
//! one buffer shows. KeyAction::baseline_reset makes them those of the show, all of them.
StereoSettings adjusted(const StereoSettings& stereo, KeyAction action, const StereoSettings& shown, double r);

//! The settings in a line: layout, model, baseline, convergence, swapped. In German for "de", else in English.
std::string describe(const StereoSettings& stereo, std::string_view language = "en");

//! The settings and what they do to a viewer's eyes, in lines: least and greatest horizontal disparity, and a warning where their difference
//! is more than the limit of comfort.
std::string disparity_caption(const StereoSettings& stereo, const std::optional<Disparity>& disparity,
                              std::string_view language = "en");

}  // namespace ergodome
