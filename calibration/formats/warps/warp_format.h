#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

// Formats of warp files, and how to recognize them.
namespace ergodome {

enum class WarpFormat { bourke, pfm, mpcdi, domeprojection, obj, sciss, easyblend, simcad, skyskan };

//! How many bytes from the beginning of a file format_of_content() needs.
inline constexpr std::size_t warp_head_bytes = 4096;

//! Returns the word for a format in a setup.
const char* word_of(WarpFormat format);

//! Returns what messages call a file of a format, for example "a SimCAD warp".
const char* name_of(WarpFormat format);

//! Returns the format that the beginning of a file shows; nothing if it shows none. Bourke's
//! meshes cannot be recognized by content.
std::optional<WarpFormat> format_of_content(std::string_view head);

//! Returns the format of a file by its content, or else by its ending; nothing if neither shows one.
std::optional<WarpFormat> warp_format_of(const std::filesystem::path& path);

//! Returns the first warp_head_bytes of a file; fewer if it is shorter, none if it cannot be read.
std::string head_of_file(const std::filesystem::path& path);

//! Returns whether the setup has to state what picture the warps of a format look up. EasyBlend files may
//! hold a view, which then takes precedence.
bool tells_no_source(WarpFormat format);

//! Returns the format that the ending of a file's name (such as ".pfm", in any case) stands for; nothing if it stands for none.
std::optional<WarpFormat> format_of_ending(std::string_view ending);

}  // namespace ergodome
