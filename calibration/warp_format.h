#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

// The kinds of warp files, and how to tell them apart.
namespace ergodome {

enum class WarpFormat { bourke, pfm, mpcdi, domeprojection, obj, sciss, easyblend, simcad, skyskan };

//! Bytes at the beginning of a file that format_of_content() needs.
inline constexpr std::size_t warp_head_bytes = 4096;

//! The word for a format in a setup.
const char* word_of(WarpFormat format);

//! What messages call a file of a format, for example "a SimCAD warp".
const char* name_of(WarpFormat format);

//! Returns the format that the beginning of a file shows; nothing if it shows none. Bourke's meshes have no mark of their own.
std::optional<WarpFormat> format_of_content(std::string_view head);

//! Returns the format of a file by its content, or else by its ending; nothing if neither shows one.
std::optional<WarpFormat> warp_format_of(const std::filesystem::path& path);

//! Returns the first warp_head_bytes of a file; fewer where it is shorter, none where it cannot be read.
std::string head_of_file(const std::filesystem::path& path);

//! Whether a format leaves it to the setup what picture its warps look up.
bool tells_no_source(WarpFormat format);

//! Returns the format that the ending of a file's name (such as ".pfm", in any case) stands for; nothing if it stands for none.
std::optional<WarpFormat> format_of_ending(std::string_view ending);

}  // namespace ergodome
