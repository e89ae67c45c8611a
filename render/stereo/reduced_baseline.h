#pragma once

#include <optional>
#include <string>

#include "content/camera/camera_path.h"
#include "content/show/show.h"

// Finds where a show's baseline has to be reduced.

namespace ergodome {

//! A baseline that had to be reduced because the show's does not fit at the camera position
//! (render/stereo/eye_distance.h).
struct ReducedBaseline {
  StereoModel model = StereoModel::physical;
  double r = 0.0;         //!< the head's radius coordinate [M]
  double asked = 0.0;     //!< baseline of the show [M]
  double baseline = 0.0;  //!< reduced baseline [M]
};

//! Where the baseline has to be reduced on a show's camera path.
struct BaselineReductions {
  double first_s = 0.0;  //!< show time of the first reduction
  ReducedBaseline first;
  double smallest_s = 0.0;  //!< sampled show time of the smallest baseline
  ReducedBaseline smallest;
};

//! Checks the baseline of a show at 33 evenly spaced times and at the times of path_ends_s(),
//! unless those are more than 16; only at 0 s if nothing changes. Returns nothing if the show's
//! baseline fits at all checked times, for a single eye, and for the model `physical`.
std::optional<BaselineReductions> baseline_reductions(const Show& show);

//! Returns a warning about the picture at a show time, with the line of the baseline's key if the
//! show file has it.
std::string note_of(const Show& show, double time_s, const ReducedBaseline& eyes);

//! Returns a warning about the reduced baseline on the whole camera path.
std::string note_of(const Show& show, const BaselineReductions& path);

}  // namespace ergodome
