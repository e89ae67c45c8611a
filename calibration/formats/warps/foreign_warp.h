#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "calibration/formats/warps/warp_format.h"
#include "calibration/warps/projector_view.h"
#include "calibration/warps/warp_mesh.h"

// Warp formats of other programs that SGCT (https://sgct.github.io) also reads.
namespace ergodome {

//! The flat image that a warp refers to: its direction in the dome's axes, and its field of view.
struct WarpView {
  Orientation orientation;
  Frustum frustum;
};

//! Returns a view in words, for messages: "yaw 30.00°, pitch 40.00°, ...".
std::string words_of(const WarpView& view);

//! A warp, and other information in its file.
struct ForeignWarp {
  WarpMesh mesh;
  std::optional<WarpView> view;    //!< absent if the file does not state what the warp refers to
  std::vector<std::string> notes;  //!< parts of the file that are not used
};

//! Reads a warp in one of the formats below. Throws Error, which names the file and if possible the
//! line, for numbers that are not finite or beyond 10,000, truncated files, sizes beyond the limits
//! of warp_mesh.h, and unsupported features.
ForeignWarp parse_foreign_warp(std::string_view bytes, const std::string& file, WarpFormat format);

//! Reads a warp from a file as parse_foreign_warp() does.
ForeignWarp read_foreign_warp(const std::filesystem::path& path, WarpFormat format);

//! Returns true if parse_foreign_warp() reads a format.
bool is_foreign(WarpFormat format);

// The readers of each format. All except .sgc are text.

//! Reads a domeprojection warp: a line "x;y;u;v;column;row" per node; x, y, u and v from 0 to 1, y
//! and v downward.
ForeignWarp parse_domeprojection_warp(std::string_view text, const std::string& file);

//! Reads a Wavefront OBJ warp: x and y from -1 to 1, y upward, constant z; texture coordinates from
//! 0 to 1, v upward.
ForeignWarp parse_obj_warp(std::string_view text, const std::string& file);

//! Reads a SCISS warp: binary, with the view as a quaternion and four angles; y downward, v upward.
ForeignWarp parse_sciss_warp(std::string_view bytes, const std::string& file);

//! Reads a Scalable EasyBlend warp: keywords, nodes "x y intensity s t" with x and y in pixels, y
//! upward, and faces "[ a b c ]".
ForeignWarp parse_easyblend_warp(std::string_view text, const std::string& file);

//! Reads a SimCAD warp (Barco): XML with offsets of a square grid in reading order, to the right
//! and downward, as fractions of "range".
ForeignWarp parse_simcad_warp(std::string_view text, const std::string& file);

//! Reads a Sky-Skan warp: direction and field of view of the image, then a grid of nodes "x y u v",
//! y and v downward; nodes at -1 are not drawn.
ForeignWarp parse_skyskan_warp(std::string_view text, const std::string& file);

}  // namespace ergodome
