#pragma once

#include <filesystem>
#include <string>

#include "calibration/dome/dome_setup.h"
#include "content/files/toml_table.h"

namespace ergodome {

//! Reads a [[projector]] of a dome setup; `folder` is where the files that it names are sought. Throws Error with line and remedy.
ProjectorSetup read_projector(TomlTable& table, const std::string& file, const std::filesystem::path& folder,
                              NamedFiles named_files);

//! A place in metres, [right, up, back]; (0, 0, 0) where the key is absent.
Vector3<double> read_place(TomlTable& table, std::string_view key);

}  // namespace ergodome
