#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

// Formats of warp files, and how to recognize them.
namespace ergodome {

enum class WarpFormat { bourke, pfm, mpcdi, domeprojection, obj, sciss, easyblend, simcad, skyskan };

//! Number of bytes at the beginning of a file that format_of_content() needs.
inline constexpr std::size_t warp_head_bytes = 4096;

//! Returns the word for a format in a setup.
const char* word_of(WarpFormat format);

//! Returns the name of a format's files in messages, for example "a SimCAD warp".
const char* name_of(WarpFormat format);

//! Returns the format that the beginning of a file indicates; nothing if it is not recognized.
//! Bourke's meshes cannot be recognized by content.
std::optional<WarpFormat> format_of_content(std::string_view head);

//! Returns the format of a file from its content, or else from its extension; nothing if neither is
//! recognized.
std::optional<WarpFormat> warp_format_of(const std::filesystem::path& path);

//! Returns the first warp_head_bytes of a file; fewer if it is shorter, none if it cannot be read.
std::string head_of_file(const std::filesystem::path& path);

//! Returns true if the files of a format do not state which image their warps refer to, so that the
//! setup may. EasyBlend files may contain a view, which then takes precedence.
bool has_no_source_size(WarpFormat format);

//! Returns the format for a file extension (such as ".pfm", in any case); nothing if it is unknown.
std::optional<WarpFormat> format_of_ending(std::string_view ending);

}  // namespace ergodome
