#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "content/show/show.h"

namespace ergodome {

//! The greatest speed of an observer of whom a show tells it.
inline constexpr double fastest_observer = 0.999999;

//! Reads a show file (TOML, see content/SHOWS.md). Throws Error with file, line, key and remedy for whatever is wrong in it: unknown keys,
//! values out of range, cameras inside the horizon, observers that cannot exist there.
Show read_show(const std::filesystem::path& path);

//! The same of a show that settings change before it is read.
Show read_show_with_settings(const std::filesystem::path& path, const ShowSettings& settings);

//! The same from text; `file` is how messages call it.
Show parse_show(std::string_view text, const std::string& file, const ShowSettings& settings = {});

//! A show as TOML text that parse_show reads back to the same show.
std::string to_toml(const Show& show);

}  // namespace ergodome
