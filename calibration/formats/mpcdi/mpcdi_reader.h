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

//! Gives the bytes of a file that an MPCDI description names, or throws Error.
using MpcdiFiles = std::function<std::string(const std::string& name, std::size_t most_bytes)>;

//! Reads a calibration: a zip archive with mpcdi.xml (or, as some programs name it, mpacs.xml), or such a description alone,
//! whose files then lie in its folder. `order` tells which row the float maps begin with: bottom_up as the format of the maps and
//! VESA's own library have it, top_down as MPCDI's text has it.
//!
//! Names of elements and attributes are matched without regard to capitals; filesets may stand in <files> or beside it; an empty
//! <path> stands for no file, as programs write that send warps by other ways. Throws Error with file and line, or the archive's
//! member, for everything else that the specification rules out, and for archives, XML and maps beyond the bounds of their
//! readers.
Mpcdi read_mpcdi(const std::filesystem::path& path, RowOrder order = RowOrder::bottom_up);

//! Files that a description names in its folder, each once; none of an archive, which holds what it names. Throws Error like read_mpcdi().
std::vector<std::filesystem::path> files_of_mpcdi(const std::filesystem::path& path);

//! The same from an archive in memory.
Mpcdi parse_mpcdi_archive(std::span<const std::byte> bytes, const std::string& name, RowOrder order);

//! The same from a description; `files` gives what it names.
Mpcdi parse_mpcdi_description(std::string_view xml, const std::string& name, const MpcdiFiles& files, RowOrder order);

}  // namespace ergodome
