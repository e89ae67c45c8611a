#pragma once

#include <cstddef>

#include "content/show/show.h"

// Properties of the eyes that a stereo model makes, so that other rooms need not know the models.

namespace ergodome {

//! Returns whether each direction of the view has a camera of its own, as with omnidirectional
//! stereo.
constexpr bool has_camera_per_direction(const StereoSettings& stereo) {
  return eye_count(stereo) > 1 && stereo.model == StereoModel::omni;
}

//! Returns whether the baseline fits at every camera position. Otherwise it may have to be reduced
//! (render/stereo/eye_distance.h).
constexpr bool fits_everywhere(StereoModel model) { return model == StereoModel::physical; }

//! Returns the model that follows in the order of stereo_model_names; the first follows the last.
constexpr StereoModel next_model(StereoModel model) {
  return static_cast<StereoModel>((static_cast<std::size_t>(model) + 1) % stereo_model_names.size());
}

//! Returns the model to use on a path that leads through the horizon: the given one, if its eyes are
//! defined inside.
constexpr StereoModel model_for_fall(StereoModel model) {
  return model == StereoModel::flat ? StereoModel::physical : model;
}

}  // namespace ergodome
