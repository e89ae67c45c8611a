#pragma once

#include <string>
#include <string_view>

namespace ergodome {

//! Limits on the structure of a TOML file. The parser recurses for each part of a dotted key, and
//! searches all tables from dotted keys and headers for each new one. Without limits, a file of 200
//! KB overflows the stack, and one of 1 MB takes minutes.
inline constexpr int max_toml_key_parts = 16;
inline constexpr int deepest_toml_nesting = 32;
inline constexpr long max_toml_values = 1'000'000;
//! Maximum number of parts of all dotted keys and table headers of a file together; a header that
//! repeats the previous one does not count.
inline constexpr long max_toml_dotted_parts = 40'000;

//! Checks the limits above without parsing. Throws Error with file and line.
void require_bounded_toml(std::string_view text, const std::string& file);

}  // namespace ergodome
