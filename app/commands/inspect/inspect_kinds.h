#pragma once

#include <filesystem>

namespace ergodome {

//! Throws Error if another command handles this kind of file, or if it belongs to a show or a
//! setup; the message names the command.
void require_inspectable(const std::filesystem::path& file);

}  // namespace ergodome
