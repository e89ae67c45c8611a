#pragma once

#include <array>
#include <string>
#include <string_view>

#include "calibration/formats/mpcdi/mpcdi.h"

// Words in MPCDI's XML, in the order of the enumerations that they stand for.
namespace ergodome {

inline constexpr std::array<std::string_view, 4> mpcdi_profile_words = {"2d", "3d", "a3", "sl"};
inline constexpr std::array<std::string_view, 4> mpcdi_origin_words = {"unknown", "centerOfMass", "idealEyePoint",
                                                                       "floorCenter"};

//! One of the nine components of a coordinateFrame's axes or the three of its position, with its
//! tag.
struct MpcdiFrameNumber {
  std::string_view tag;
  Vector3<double> MpcdiFrame::*vector;
  double Vector3<double>::*component;
};

inline constexpr std::array<MpcdiFrameNumber, 12> mpcdi_frame_numbers = {{
    {"posx", &MpcdiFrame::position, &Vector3<double>::x},
    {"posy", &MpcdiFrame::position, &Vector3<double>::y},
    {"posz", &MpcdiFrame::position, &Vector3<double>::z},
    {"yawx", &MpcdiFrame::yaw_axis, &Vector3<double>::x},
    {"yawy", &MpcdiFrame::yaw_axis, &Vector3<double>::y},
    {"yawz", &MpcdiFrame::yaw_axis, &Vector3<double>::z},
    {"pitchx", &MpcdiFrame::pitch_axis, &Vector3<double>::x},
    {"pitchy", &MpcdiFrame::pitch_axis, &Vector3<double>::y},
    {"pitchz", &MpcdiFrame::pitch_axis, &Vector3<double>::z},
    {"rollx", &MpcdiFrame::roll_axis, &Vector3<double>::x},
    {"rolly", &MpcdiFrame::roll_axis, &Vector3<double>::y},
    {"rollz", &MpcdiFrame::roll_axis, &Vector3<double>::z},
}};

}  // namespace ergodome
