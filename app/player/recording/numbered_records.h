#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>

namespace ergodome {

//! Returns the number of a file among the recordings of `record`: for flight.toml these are
//! flight-000001.toml, flight-000002.toml, ... in the same folder, with six digits. Returns nothing
//! if the name is not that of a recording.
std::optional<long> record_number(const std::filesystem::path& record, const std::filesystem::path& file);

//! Returns the name of the next recording: its number is above all existing ones, and no file has
//! that name. Throws Error if the folder cannot be read, and after number 999999.
std::filesystem::path next_record(const std::filesystem::path& record);

//! Removes the recordings with the lowest numbers, keeping the last `maximum`. Ignores files that
//! cannot be removed. Throws Error if the folder cannot be read.
void remove_oldest_records(const std::filesystem::path& record, std::size_t maximum);

}  // namespace ergodome
