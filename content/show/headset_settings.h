#pragma once

#include <array>
#include <cstdint>

namespace ergodome {

//! Where a headset's eyes are: as in a StereoModel, or `mono`, both at the head.
enum class HeadsetStereo : std::int32_t { flat, physical, omni, mono };

//! Names of HeadsetStereo, in its order.
inline constexpr std::array headset_stereo_names = {"flat", "physical", "omni", "mono"};

//! Stereo and comfort settings of headsets: a show's [headset].
struct HeadsetSettings {
  HeadsetStereo stereo = HeadsetStereo::flat;
  //! Length in the show that corresponds to a meter of the viewer's room [M per meter]; 0: derived
  //! from the distance to the horizon.
  double scale = 0.0;
  bool rest_frame = true;       //!< shows a ring and a floor grid that are fixed in the viewer's room
  double vignette = 1.0;        //!< strength of the vignette during motion; 0: none
  double fade_s = 0.3;          //!< duration of a fade through black; 0: none
  double snap_turn_deg = 30.0;  //!< angle of a snap turn; 0: the view turns smoothly instead
  double exposure_rate = 1.0;   //!< maximum change of the exposure [stops/s]; 0: no limit
  bool panel = true;            //!< shows captions and help on a panel in the viewer's room

  bool operator==(const HeadsetSettings&) const = default;
};

}  // namespace ergodome
