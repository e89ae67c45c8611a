#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "calibration/warps/blend_map.h"
#include "calibration/warps/pfm.h"
#include "calibration/warps/projector_view.h"
#include "kernels/core/vector3.h"

// The contents of a file in VESA's Multiple Projection Common Data Interchange (MPCDI), versions
// 1.0 (2013) and 2.0 (2015), uninterpreted. mpcdi_conversion.h converts them to warps, masks and
// poses.

namespace ergodome {

enum class MpcdiProfile {
  media_2d,       //!< "2d": a warped flat image
  simulation_3d,  //!< "3d": each projector shows a warped frustum of the scene
  advanced_3d,    //!< "a3": the surface that each projector lights
  shader_lamps,   //!< "sl": the surface that each projector lights, and the poses of the projectors
};

//! Returns true if regions of a profile define the orientation of projectors.
constexpr bool is_posed(MpcdiProfile profile) {
  return profile == MpcdiProfile::simulation_3d || profile == MpcdiProfile::shader_lamps;
}

//! Returns true if the warps of a profile contain lengths, so that their unit matters.
constexpr bool has_lengths(MpcdiProfile profile) {
  return profile == MpcdiProfile::advanced_3d || profile == MpcdiProfile::shader_lamps;
}

//! Syntax of a version: version 2 has the attributes geometry and color, version 1 has level.
enum class MpcdiVersion { one, two };

//! Origin of the coordinates of 3D data.
enum class MpcdiOrigin { unknown, centre_of_mass, ideal_eye_point, floor_centre };

//! A projector's position in the coordinates of the file, and three orthonormal vectors in these
//! coordinates, about which the projector's yaw, pitch and roll rotate: they point down, right and
//! forward.
struct MpcdiFrame {
  Vector3<double> position{};
  Vector3<double> yaw_axis{};
  Vector3<double> pitch_axis{};
  Vector3<double> roll_axis{};
};

//! A fisheye lens in Christie's "BufferExtension". Radius in half-widths of the raster: r = f1 t +
//! f3 t^3 + f5 t^5 + f7 t^7, t in rad.
struct MpcdiFisheye {
  double horizontal_offset = 0.0;  //!< offset of the lens's axis to the right [half-widths of the raster]
  double vertical_offset = 0.0;    //!< offset of the lens's axis upward [half-heights of the raster]
  double coefficients[4] = {};     //!< f1, f3, f5, f7
  double anamorphic_ratio = 1.0;   //!< height of a pixel over its width
  double anamorphic_angle_deg = 0.0;
};

//! A geometryWarpFile with its map.
struct MpcdiGeometry {
  FloatMap map;
  std::string interpolation = "linear";
  std::string unit = "unknown";  //!< unit of 3D data: mm, cm, dm, m, in, ft, yd or unknown
  MpcdiOrigin origin = MpcdiOrigin::unknown;
};

//! An alphaMap or betaMap. Its values to the power of `gamma_embedded` are linear light.
struct MpcdiMask {
  BlendMap map;
  double gamma_embedded = 1.0;
};

//! One projector.
struct MpcdiRegion {
  std::string id;
  double x = 0.0;  //!< left edge in the buffer, 0 to 1; y likewise from the top
  double y = 0.0;
  double width = 1.0;
  double height = 1.0;
  int resolution_x = 0;  //!< [px]
  int resolution_y = 0;
  std::optional<Orientation> orientation;  //!< present if `frustum` is
  std::optional<Frustum> frustum;
  std::optional<MpcdiFrame> frame;
  std::optional<MpcdiFisheye> fisheye;
  //! Gamma from the source to linear light; absent if the file does not state it.
  std::optional<double> decode_gamma;
  //! Gamma from linear light to the projector's input; absent if the file does not state it.
  std::optional<double> encode_gamma;
  std::optional<MpcdiGeometry> geometry;
  //! Unit of the frame's position; may be stated without a warp.
  std::string unit = "unknown";
  std::optional<MpcdiMask> alpha;      //!< remaining fraction of the projector's light in overlaps
  std::optional<MpcdiMask> beta;       //!< black-level lift
  std::optional<FloatMap> distortion;  //!< profile sl: the lens's own 2D warp
};

struct MpcdiBuffer {
  std::string id;
  int resolution_x = 0;  //!< [px]; 0 if the file does not state it
  int resolution_y = 0;
  std::vector<MpcdiRegion> regions;
};

struct Mpcdi {
  MpcdiProfile profile = MpcdiProfile::media_2d;
  MpcdiVersion version = MpcdiVersion::two;
  int geometry_level = 1;  //!< level of the geometry: 1 or 2
  int color_level = 1;     //!< level of the color data: 1 to 5; above 2 there is a betaMap
  std::string date;        //!< "yyyy-MM-dd HH:mm:ss"
  std::vector<MpcdiBuffer> buffers;
  std::vector<std::string> left_out;  //!< features of the file that the reader ignores, with their lines
};

//! Returns the length of a geometricUnit in meters; an unknown unit counts as meters.
double metres_of_unit(const std::string& unit);

// Words in MPCDI's XML, in the order of the enumerations that they stand for.
inline constexpr std::array<std::string_view, 4> mpcdi_profile_words = {"2d", "3d", "a3", "sl"};
inline constexpr std::array<std::string_view, 4> mpcdi_origin_words = {"unknown", "centerOfMass", "idealEyePoint",
                                                                       "floorCenter"};

//! One number of an XML <coordinateFrame>, with its tag: one of nine components of the axes or of
//! three components of the position.
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
