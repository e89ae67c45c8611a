#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace ergodome {

//! Throws UsageError if the name of an output table has the ending of another format; `option`
//! names it. `.csv`, `.txt` and names without an ending mean CSV; `.tsv` means tabs; `.json` means
//! an array of objects.
void require_table_ending(const std::string& option, const std::filesystem::path& table);

//! Writes a table in the format given by its ending. `csv` is its text, with a header line. Numbers
//! keep their digits in every format; in JSON, cells of `id` are strings and empty cells null.
//! Throws Error if it cannot be written.
void write_table(const std::filesystem::path& table, std::string_view csv);

}  // namespace ergodome
