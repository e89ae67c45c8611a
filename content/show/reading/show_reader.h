#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "content/show/show.h"

namespace ergodome {

//! Maximum speed of an observer's velocity in a show file [c].
inline constexpr double fastest_observer = 0.999999;

//! Reads a show file (TOML, see reference/show-keys.md in the documentation). Throws Error with
//! file, line, key and remedy for any mistake: unknown keys, values out of range, cameras inside
//! the horizon, observers that cannot exist there.
Show read_show(const std::filesystem::path& path);

//! Reads a show file after applying settings to it.
Show read_show_with_settings(const std::filesystem::path& path, const ShowSettings& settings);

//! Reads a show from text; `file` is its name in messages.
Show parse_show(std::string_view text, const std::string& file, const ShowSettings& settings = {});

//! Returns a show as TOML text from which parse_show() reads the same show.
std::string to_toml(const Show& show);

}  // namespace ergodome
