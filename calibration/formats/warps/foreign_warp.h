#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "calibration/dome/orientation.h"
#include "calibration/formats/warps/warp_format.h"
#include "calibration/warps/warp_mesh.h"

// Warp formats of other programs: those that SGCT (https://sgct.github.io) reads as well.
namespace ergodome {

//! The flat picture that a warp looks up: its direction, in the dome's axes, and its field of view.
struct WarpView {
  Orientation orientation;
  Frustum frustum;
};

//! Returns a view in words, for messages: "yaw 30.00°, pitch 40.00°, ...".
std::string words_of(const WarpView& view);

//! A warp, and what else its file holds.
struct ForeignWarp {
  WarpMesh mesh;
  std::optional<WarpView> view;    //!< absent if the file does not state what the warp looks up
  std::vector<std::string> notes;  //!< parts of the file that are not used
};

//! Reads a warp in one of the formats below. Throws Error, naming the file and where possible the line, for
//! numbers that are not finite or beyond 10,000, for truncated files, for sizes beyond the limits of
//! warp_mesh.h, and for unsupported features.
ForeignWarp parse_foreign_warp(std::string_view bytes, const std::string& file, WarpFormat format);

//! Reads a warp from a file, as parse_foreign_warp() does.
ForeignWarp read_foreign_warp(const std::filesystem::path& path, WarpFormat format);

//! Returns whether parse_foreign_warp() reads a format.
bool is_foreign(WarpFormat format);

// The readers of each format. All but .sgc are text.

//! domeprojection: "x;y;u;v;column;row", a line for each node; x, y, u and v from 0 to 1, y and v downwards.
ForeignWarp parse_domeprojection_warp(std::string_view text, const std::string& file);

//! Wavefront OBJ: x and y from -1 to 1, y upwards, z the same everywhere; texture coordinates from 0 to 1, v upwards.
ForeignWarp parse_obj_warp(std::string_view text, const std::string& file);

//! SCISS: binary, with the view as a quaternion and four angles; y downwards, v upwards.
ForeignWarp parse_sciss_warp(std::string_view bytes, const std::string& file);

//! Scalable EasyBlend: keywords, nodes "x y intensity s t" with x and y in pixels, y upwards, and faces "[ a b c ]".
ForeignWarp parse_easyblend_warp(std::string_view text, const std::string& file);

//! SimCAD (Barco): XML with offsets of a square grid in reading order, to the right and downwards, in parts of "range".
ForeignWarp parse_simcad_warp(std::string_view text, const std::string& file);

//! Sky-Skan: direction and field of view of the picture, then a grid of nodes "x y u v", y and v downwards; nodes at -1
//! are not drawn.
ForeignWarp parse_skyskan_warp(std::string_view text, const std::string& file);

}  // namespace ergodome
