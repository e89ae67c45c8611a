#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>

namespace ergodome {

//! The number that a file has among the records of `record`: flight.toml's are flight-000001.toml, flight-000002.toml and so on, beside it, with six digits each.
//! Nothing where its name is none of a record.
std::optional<long> record_number(const std::filesystem::path& record, const std::filesystem::path& file);

//! The name of the next record: its number is above those of all that are there, and nothing has that name. Throws Error where the folder cannot be read,
//! and behind number 999999.
std::filesystem::path next_record(const std::filesystem::path& record);

//! Removes the records of the least numbers but for the last `most`; what cannot be removed stays.
void remove_oldest_records(const std::filesystem::path& record, std::size_t most);

}  // namespace ergodome
