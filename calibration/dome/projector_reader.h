#pragma once

#include <filesystem>
#include <string>

#include "calibration/dome/dome_setup.h"
#include "content/files/toml_table.h"

namespace ergodome {

//! Reads a [[projector]] of a dome setup; `folder` is the base of the files that it names. Throws
//! Error with line and remedy.
ProjectorSetup read_projector(TomlTable& table, const std::string& file, const std::filesystem::path& folder,
                              NamedFiles named_files);

//! Reads a position in meters, [right, up, back]; returns (0, 0, 0) if the key is absent.
Vector3<double> read_position(TomlTable& table, std::string_view key);

}  // namespace ergodome
