#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "calibration/formats/mpcdi/mpcdi.h"

namespace ergodome {

//! Returns the bytes of a file that an MPCDI description names, or throws Error.
using MpcdiFiles = std::function<std::string(const std::string& name, std::size_t max_bytes)>;

//! Reads a calibration: a zip archive with mpcdi.xml (or mpacs.xml, as some programs name it), or
//! such a description, with its files in the same folder. `order` is the row order of the float
//! maps: bottom_up as in the format of the maps and in VESA's library, top_down as in the text of
//! MPCDI.
//!
//! Element and attribute names are case-insensitive. Filesets may be inside <files> or beside it.
//! An empty <path> means no file; programs that transfer warps in other ways write it. Throws Error
//! with file and line, or the archive's member, for everything else that the specification forbids,
//! and for archives, XML and maps beyond the limits of their readers.
Mpcdi read_mpcdi(const std::filesystem::path& path, RowOrder order = RowOrder::bottom_up);

//! Returns the files in its folder that a description names, each once; none for an archive, which
//! contains them. Throws Error as read_mpcdi() does.
std::vector<std::filesystem::path> files_of_mpcdi(const std::filesystem::path& path);

//! Reads a calibration from an archive in memory.
Mpcdi parse_mpcdi_archive(std::span<const std::byte> bytes, const std::string& name, RowOrder order);

//! Reads a calibration from a description; `files` reads the files that it names.
Mpcdi parse_mpcdi_description(std::string_view xml, const std::string& name, const MpcdiFiles& files, RowOrder order);

}  // namespace ergodome
