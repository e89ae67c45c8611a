#pragma once

#include <cstddef>
#include <optional>

#include "content/show/show.h"

// Properties of the eyes that a stereo model makes. Other folders use these functions instead of
// comparing models.

namespace ergodome {

//! The cameras that a pair of eyes is drawn with.
enum class EyeCameras {
  own,           //!< each eye has its own camera
  shared,        //!< both eyes use the head's camera; things near the hole are shifted for each eye
  per_direction  //!< each eye has one camera per direction of the view, as with omnidirectional stereo
};

constexpr EyeCameras eye_cameras(StereoModel model) {
  return model == StereoModel::flat   ? EyeCameras::shared
         : model == StereoModel::omni ? EyeCameras::per_direction
                                      : EyeCameras::own;
}

//! Returns whether there are two eyes at different positions that share the head's camera.
constexpr bool share_camera(const StereoSettings& stereo) {
  return eye_count(stereo) > 1 && eye_cameras(stereo.model) == EyeCameras::shared && stereo.baseline > 0.0;
}

//! Returns whether there are two eyes that have a camera per direction of the view.
constexpr bool has_camera_per_direction(const StereoSettings& stereo) {
  return eye_count(stereo) > 1 && eye_cameras(stereo.model) == EyeCameras::per_direction;
}

//! Returns whether the baseline fits at every camera position. Otherwise it may have to be reduced
//! (render/stereo/eye_distance.h).
constexpr bool fits_everywhere(StereoModel model) { return model == StereoModel::physical; }

//! Returns the stereo model of a headset's eyes; absent for HeadsetStereo::mono, where both eyes see
//! the head's view.
constexpr std::optional<StereoModel> stereo_model(HeadsetStereo stereo) {
  switch (stereo) {
    case HeadsetStereo::flat:
      return StereoModel::flat;
    case HeadsetStereo::physical:
      return StereoModel::physical;
    case HeadsetStereo::omni:
      return StereoModel::omni;
    case HeadsetStereo::mono:
      break;
  }
  return std::nullopt;
}

//! Returns the model that follows in the order of stereo_model_names; the first follows the last.
constexpr StereoModel next_model(StereoModel model) {
  return static_cast<StereoModel>((static_cast<std::size_t>(model) + 1) % stereo_model_names.size());
}

//! Returns the model to use on a path that leads through the horizon: the given one if its eyes are
//! defined inside the horizon, otherwise StereoModel::physical.
constexpr StereoModel model_for_fall(StereoModel model) {
  return model == StereoModel::flat ? StereoModel::physical : model;
}

}  // namespace ergodome
