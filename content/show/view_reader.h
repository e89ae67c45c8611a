#pragma once

#include <toml++/toml.h>

#include <string>

#include "content/show/show.h"

namespace ergodome {

//! Reads [view], the projection of the view onto an image.
void read_view(const toml::table& table, const std::string& file, ViewSettings& view);

}  // namespace ergodome
