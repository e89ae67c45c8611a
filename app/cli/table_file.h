#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace ergodome {

//! Throws UsageError where the name of a table that `option` asks for ends in a way that stands for another format. `.csv`,
//! `.txt` and names without an ending are CSV; `.tsv` has tabs; `.json` is an array of objects.
void require_table_ending(const std::string& option, const std::filesystem::path& table);

//! Writes a table in the format of its name's ending. `csv`: its text, with a line that names the columns. Numbers keep their
//! digits in every format; in JSON the cells of `id` are strings, and empty cells null. Throws Error where it cannot.
void write_table(const std::filesystem::path& table, std::string_view csv);

}  // namespace ergodome
