#pragma once

#include <filesystem>
#include <functional>
#include <initializer_list>
#include <string>
#include <string_view>

namespace ergodome {

//! Checks an output file before a command does any work. `option` names it in messages ("--out").
//! Throws UsageError if it is one of the input files, under any name, which would be overwritten.
//! Ignores empty names.
void require_other_file(const std::string& option, const std::filesystem::path& written,
                        std::initializer_list<std::filesystem::path> read);

//! Checks an output file as require_other_file() does. Also throws Error if its folder does not
//! exist: only folders named by an option themselves are created.
void require_output_file(const std::string& option, const std::filesystem::path& written,
                         std::initializer_list<std::filesystem::path> read);

//! Checks an output file as require_output_file() does. Also throws UsageError if the name does not
//! end in .png.
void require_other_png(const std::string& option, const std::filesystem::path& written,
                       std::initializer_list<std::filesystem::path> read);

//! Throws UsageError if the name of an output table has the ending of another format; `option`
//! names it. `.csv`, `.txt` and names without an ending mean CSV; `.tsv` means tabs; `.json` means
//! an array of objects.
void require_table_ending(const std::string& option, const std::filesystem::path& table);

//! Writes a table in the format given by its ending. `csv` is its text, with a header line and
//! without quotes. Numbers keep their digits in every format. In JSON, cells of `id` are strings,
//! and empty and non-finite cells are null. Throws Error if it cannot be written, or if a cell of a
//! .tsv table contains a tab.
void write_table(const std::filesystem::path& table, std::string_view csv);

//! Takes the next part of a table's CSV text.
using TablePartWriter = std::function<void(std::string_view part)>;

//! Writes a table as write_table() does, but while it is computed: `compute` passes its text part
//! by part. CSV text is not kept in memory. Nothing is written if `compute` throws.
void write_table_in_parts(const std::filesystem::path& table,
                          const std::function<void(const TablePartWriter& write)>& compute);

}  // namespace ergodome
