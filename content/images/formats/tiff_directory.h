#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

namespace ergodome {

//! Returns what is wrong with the strips or tiles of the first image of a TIFF, in a file or, if
//! given, in `bytes`: some lie beyond the end of the data, or are shorter than their pixels need.
//! OpenImageIO reads such pixels as black. Returns an empty text if nothing is wrong, and for files
//! that libtiff cannot open.
std::string problem_of_tiff(const std::string& name, const std::optional<std::span<const std::byte>>& bytes);

//! Returns the ICC profile of a TIFF's first image; empty if it has none, and for files of other
//! formats.
std::string tiff_icc_profile(const std::string& name, const std::optional<std::span<const std::byte>>& bytes);

}  // namespace ergodome
