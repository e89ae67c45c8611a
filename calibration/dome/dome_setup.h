#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "calibration/dome/orientation.h"
#include "calibration/formats/warps/pfm.h"
#include "calibration/formats/warps/warp_format.h"
#include "calibration/projectors/lens.h"
#include "calibration/warps/warp_conversion.h"
#include "kernels/core/vector3.h"

// A dome with its projectors. Places are in metres from the middle of the dome's sphere, x right, y straight up, z back, for a
// viewer who looks to the front; y stays upright when the dome is tilted.
namespace ergodome {

//! A convex mirror between projector and dome.
struct SphericalMirror {
  Vector3<double> position_m{};
  double radius_m = 0.3;
};

//! Where a projector's picture is shown: full screen on a monitor, or in a window of the projector's resolution.
struct ProjectorOutput {
  std::optional<int> monitor;  //!< counted from 0
  int window_x_px = 0;         //!< top left corner of the window on the desktop
  int window_y_px = 0;
};

//! What picture a flat warp looks up.
enum class WarpSource {
  dome_picture,  //!< the domemaster, or the whole buffer of an MPCDI calibration
  lens_picture,  //!< what the projector's lens (as in MPCDI's profile 3d), or a view in the file, shows of the scene
};

//! A file with a projector's warp, and how it is to be read.
struct WarpFile {
  std::string file;  //!< as the setup writes it: beside the setup, or from the root
  WarpFormat format = WarpFormat::bourke;
  RowOrder rows = RowOrder::bottom_up;                     //!< of float maps
  TextureDirection texture = TextureDirection::downwards;  //!< of float maps alone
  std::string region;                                      //!< of an MPCDI calibration; empty: its only one
  bool x_to_one = false;                                   //!< Bourke: x runs to 1, not to the raster's aspect
  WarpSource source = WarpSource::dome_picture;            //!< for formats that do not state it
};

struct ProjectorSetup {
  std::string name;
  std::string read_from;  //!< file and line, for messages ("dome.toml:12"); empty where it came from no file
  Vector3<double> position_m{};
  Orientation orientation;
  Lens lens;
  std::optional<SphericalMirror> mirror;
  int width_px = 0;
  int height_px = 0;
  ProjectorOutput output;
  std::optional<WarpFile> warp;
  std::string blend_mask;                           //!< factor of the light; empty: none
  double blend_mask_gamma = 1.0;                    //!< its values are raised to this to become linear
  std::string black_level_mask;                     //!< where the lift is added; empty: everywhere
  Vector3<double> black_level_lift{0.0, 0.0, 0.0};  //!< red, green, blue; linear, of the projector's full light
  double gamma = 2.2;                               //!< of the projector: light = value ^ gamma
  Vector3<double> gain{1.0, 1.0, 1.0};              //!< factors of linear light, red, green, blue
};

//! How messages call a projector: "dome.toml:12, projector north".
std::string place_of(const ProjectorSetup& projector);

struct DomeSetup {
  double radius_m = 5.0;
  double tilt_deg = 0.0;      //!< how far the dome's top leans to the front
  bool tilt_known = false;    //!< whether the setup states it, so that shows follow it
  double rotation_deg = 0.0;  //!< how far the picture is turned to the right about the dome's own axis
  Vector3<double> viewer_m{0.0, 0.0, 0.0};
  std::vector<ProjectorSetup> projectors;
  std::filesystem::path folder;  //!< of the setup's file; files that it names are sought from there
};

//! Whether files that a setup names are looked for while it is read, so that a missing one is told with its line.
enum class NamedFiles { must_exist, unchecked };

//! Reads a setup (TOML). Throws Error with file, line, key and remedy for whatever is wrong in it: unknown keys, values out of range,
//! lenses that are impossible, projectors that share a name or an output, warps in a format that cannot be told, missing files.
DomeSetup read_dome_setup(const std::filesystem::path& path);

//! The same from text; `file` is how messages call it, and its folder is where named files are.
DomeSetup parse_dome_setup(std::string_view text, const std::string& file, NamedFiles named_files);

//! A setup as TOML text that parse_dome_setup reads back to the same.
std::string to_toml(const DomeSetup& setup);

//! Writes a setup, whole or not at all; an older file of that name is kept as NAME.bak.
void write_dome_setup(const std::filesystem::path& path, const DomeSetup& setup);

}  // namespace ergodome
