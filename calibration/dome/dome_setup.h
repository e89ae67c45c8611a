#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "calibration/formats/warps/warp_format.h"
#include "calibration/warps/pfm.h"
#include "calibration/warps/projector_view.h"
#include "calibration/warps/warp_conversion.h"
#include "kernels/core/vector3.h"

// A dome with its projectors. Positions are in meters from the center of the dome's sphere, x
// right, y vertically up, z back, for a viewer who faces the front; y stays vertical when the dome
// is tilted.
namespace ergodome {

//! A convex mirror between projector and dome.
struct SphericalMirror {
  Vector3<double> position_m{};
  double radius_m = 0.3;
};

//! The output of a projector: full screen on a monitor, or a window of the projector's resolution.
struct ProjectorOutput {
  std::optional<int> monitor;  //!< counted from 0
  int window_x_px = 0;         //!< top left corner of the window on the desktop
  int window_y_px = 0;
};

//! The image that a flat warp refers to.
enum class WarpSource {
  dome_picture,  //!< the domemaster, or the image of the whole buffer of an MPCDI calibration
  lens_picture,  //!< the scene through the projector's lens (as in MPCDI's profile 3d), or through a view in the file
};

//! A file with a projector's warp, and options for reading it.
struct WarpFile {
  std::string file;  //!< path as written in the setup: relative to the setup, or absolute
  WarpFormat format = WarpFormat::bourke;
  RowOrder rows = RowOrder::bottom_up;  //!< row order of float maps
  //! Direction of texture coordinates in float maps.
  TextureDirection texture = TextureDirection::downwards;
  //! Id of the region in an MPCDI calibration; empty if it has only one.
  std::string region;
  bool x_to_one = false;  //!< Bourke: x at the right side is 1, not the aspect ratio
  //! Image that the warp refers to, for formats that do not state it.
  WarpSource source = WarpSource::dome_picture;
};

//! How the computers of a dome show a frame at the same time: not at all; all wait until the last
//! one is ready; or their graphics cards also swap together (GLX_NV_swap_group).
enum class SwapSync { none, barrier, nv_swap_group };
inline constexpr std::array swap_sync_names = {"none", "barrier", "nv_swap_group"};

//! The computers that show a dome together.
struct ClusterSetup {
  SwapSync sync = SwapSync::barrier;
  std::string address = "127.0.0.1";  //!< address or network interface on which the master listens
  int port = 7653;
  std::string key;  //!< file with the keys of the cluster, relative to the setup
};

struct ProjectorSetup {
  std::string name;
  std::string node;       //!< computer that the projector is connected to; empty: the master
  std::string read_from;  //!< file and line, for messages ("dome.toml:12"); empty if not read from a file
  Vector3<double> position_m{};
  Orientation orientation;
  Lens lens;
  std::optional<SphericalMirror> mirror;
  int width_px = 0;
  int height_px = 0;
  ProjectorOutput output;
  std::optional<WarpFile> warp;
  std::string blend_mask;         //!< file with factors of the light; empty: none
  double blend_mask_gamma = 1.0;  //!< values of the blend mask to this power are linear light
  //! File with the factor of the lift per pixel; empty: the lift is the same everywhere.
  std::string black_level_mask;
  Vector3<double> black_level_lift{0.0, 0.0, 0.0};  //!< red, green, blue; linear fraction of the full light
  //! Gamma of the projector: light = value ^ gamma.
  double gamma = 2.2;
  Vector3<double> gain{1.0, 1.0, 1.0};  //!< factors of linear light, red, green, blue
};

//! Returns the name of a projector for messages: "dome.toml:12, projector north".
std::string location_of(const ProjectorSetup& projector);

struct DomeSetup {
  double radius_m = 5.0;
  double tilt_deg = 0.0;      //!< inclination of the dome's top to the front
  bool tilt_known = false;    //!< true if the setup states the tilt, so that shows follow it
  double rotation_deg = 0.0;  //!< rotation of the image to the right around the dome's own axis
  Vector3<double> viewer_m{0.0, 0.0, 0.0};
  std::vector<ProjectorSetup> projectors;
  std::optional<ClusterSetup> cluster;  //!< present if several computers show the dome
  std::filesystem::path folder;         //!< folder of the setup file; base of the files that it names
};

//! Whether reading a setup checks that the files it names exist, so that a missing one is reported
//! with its line.
enum class NamedFiles { must_exist, unchecked };

//! Reads a setup (TOML). Throws Error with file, line, key and remedy for any mistake: unknown
//! keys, values out of range, impossible lenses, projectors that share a name or an output of a
//! computer, warps of unknown format, missing files.
DomeSetup read_dome_setup(const std::filesystem::path& path);

//! Reads a setup from text; `file` is its name in messages, and its folder is the base of named
//! files.
DomeSetup parse_dome_setup(std::string_view text, const std::string& file, NamedFiles named_files);

//! Returns a setup as TOML text from which parse_dome_setup() reads the same setup.
std::string to_toml(const DomeSetup& setup);

//! Returns the names of the nodes that projectors are connected to, each once, in the order of the
//! setup. The master is not among them.
std::vector<std::string> node_names(const DomeSetup& setup);

//! Returns a setup with only the projectors that are connected to a node; empty: to the master.
DomeSetup part_of_setup(const DomeSetup& setup, const std::string& node);

//! Writes a setup atomically; keeps an older file of that name as NAME.bak.
void write_dome_setup(const std::filesystem::path& path, const DomeSetup& setup);

}  // namespace ergodome
