#pragma once

#include <filesystem>

namespace ergodome {

//! Throws Error where a file is of a kind that another command looks into, or that a show or a setup names: it says which.
void require_inspectable(const std::filesystem::path& file);

}  // namespace ergodome
