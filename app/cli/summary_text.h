#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace ergodome {

// Text of summaries: counts, sizes and durations for people, JSON for programs.

//! Formats a count with commas between thousands, in any locale.
std::string grouped(long count);

//! Formats a size in powers of 1000, as disks are sold: "25 kB", "1.1 GB". Rounds to two digits
//! below 10, otherwise to an integer.
std::string size_text(std::uintmax_t bytes);

//! Formats a duration: "0.25 s", "45 s", "30 min", "2 h 10 min", "3 d 4 h". From an hour on, it has
//! the two largest units, without a zero; below 0.01 s, it is "10 ms or less".
std::string duration_text(double seconds);

//! Formats a summary as JSON. Invalid UTF-8, such as in file names, becomes replacement characters.
std::string json_text(const nlohmann::json& summary);

}  // namespace ergodome
