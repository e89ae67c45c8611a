#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibration/dome/orientation.h"
#include "calibration/formats/warps/pfm.h"
#include "calibration/projectors/blend_map.h"
#include "kernels/core/vector3.h"

// VESA's Multiple Projection Common Data Interchange (MPCDI), versions 1.0 (2013) and 2.0 (2015): what such a file says, as it
// says it. Its readings as warps, masks and places are in mpcdi_conversion.h.
namespace ergodome {

enum class MpcdiProfile {
  media_2d,       //!< "2d": a flat image, warped
  simulation_3d,  //!< "3d": each projector shows a frustum of the scene, warped
  advanced_3d,    //!< "a3": the surface that each projector meets
  shader_lamps,   //!< "sl": the same, and where the projectors stand
};

//! Whether regions of a profile tell where projectors look.
constexpr bool is_posed(MpcdiProfile profile) {
  return profile == MpcdiProfile::simulation_3d || profile == MpcdiProfile::shader_lamps;
}

//! Returns whether the warps of a profile hold lengths, so that their unit counts.
constexpr bool has_lengths(MpcdiProfile profile) {
  return profile == MpcdiProfile::advanced_3d || profile == MpcdiProfile::shader_lamps;
}

//! How version 2 and version 1 spell themselves: geometry= and color=, or level=.
enum class MpcdiVersion { one, two };

//! What the coordinates of 3D data are counted from.
enum class MpcdiOrigin { unknown, centre_of_mass, ideal_eye_point, floor_centre };

//! A projector's place in the coordinates of the file, and which way those run: the axes of yaw (down), pitch (right) and roll
//! (forward), orthonormal.
struct MpcdiFrame {
  Vector3<double> position{};
  Vector3<double> yaw_axis{};
  Vector3<double> pitch_axis{};
  Vector3<double> roll_axis{};
};

//! A fisheye lens, in Christie's "BufferExtension": radius in half-widths of the raster r = f1 t + f3 t^3 + f5 t^5 + f7 t^7, t in rad.
struct MpcdiFisheye {
  double horizontal_offset = 0.0;  //!< half-widths
  double vertical_offset = 0.0;    //!< half-heights
  double coefficients[4] = {};     //!< f1, f3, f5, f7
  double anamorphic_ratio = 1.0;   //!< a pixel's height over its width
  double anamorphic_angle_deg = 0.0;
};

//! A geometryWarpFile with its map.
struct MpcdiGeometry {
  FloatMap map;
  std::string interpolation = "linear";
  std::string unit = "unknown";  //!< of 3D data: mm, cm, dm, m, in, ft, yd or unknown
  MpcdiOrigin origin = MpcdiOrigin::unknown;
};

//! An alphaMap or betaMap: the values decode to linear light by this gamma.
struct MpcdiMask {
  BlendMap map;
  double gamma_embedded = 1.0;
};

//! One projector.
struct MpcdiRegion {
  std::string id;
  double x = 0.0;  //!< in its buffer, 0 to 1 from the left; likewise y from the top
  double y = 0.0;
  double width = 1.0;
  double height = 1.0;
  int resolution_x = 0;  //!< [px]
  int resolution_y = 0;
  std::optional<Orientation> orientation;  //!< with `frustum`
  std::optional<Frustum> frustum;
  std::optional<MpcdiFrame> frame;
  std::optional<MpcdiFisheye> fisheye;
  std::optional<double> decode_gamma;  //!< from the source's values to linear light; absent where the file says none
  std::optional<double>
      encode_gamma;  //!< from linear light to what the projector is sent; absent where the file says none
  std::optional<MpcdiGeometry> geometry;
  std::string unit = "unknown";        //!< of the frame's position; a file may state it without naming a warp
  std::optional<MpcdiMask> alpha;      //!< what is left of the projector's light where it meets others
  std::optional<MpcdiMask> beta;       //!< black-level lift
  std::optional<FloatMap> distortion;  //!< sl: the lens's own 2D warp
};

struct MpcdiBuffer {
  std::string id;
  int resolution_x = 0;  //!< [px]; 0 where the file does not say
  int resolution_y = 0;
  std::vector<MpcdiRegion> regions;
};

struct Mpcdi {
  MpcdiProfile profile = MpcdiProfile::media_2d;
  MpcdiVersion version = MpcdiVersion::two;
  int geometry_level = 1;  //!< 1 or 2
  int color_level = 1;     //!< 1 to 5; above 2 there is a betaMap
  std::string date;        //!< "yyyy-MM-dd HH:mm:ss"
  std::vector<MpcdiBuffer> buffers;
  std::vector<std::string> left_out;  //!< what the file asks for and the reader passes over, with its line
};

//! Metres in a geometricUnit; data of unknown unit are taken for metres.
double metres_of_unit(const std::string& unit);

}  // namespace ergodome
