#pragma once

#include <filesystem>

namespace ergodome {

//! Throws Error if `inspect` does not support this kind of file, such as a catalogue, a warp, a
//! mesh or a sound; the remedy names the command, show or setup to use it with.
void require_inspectable(const std::filesystem::path& file);

}  // namespace ergodome
