#include "app/cli/output_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <vector>

#include "app/cli/usage_error.h"
#include "content/files/atomic_file.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

std::string lower_ending(const std::filesystem::path& table) {
  std::string ending = table.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  for (std::size_t comma = line.find(','); comma != std::string_view::npos; comma = line.find(',')) {
    cells.push_back(line.substr(0, comma));
    line.remove_prefix(comma + 1);
  }
  cells.push_back(line);
  return cells;
}

//! Returns a cell as JSON: a number with all its digits, null if it is empty or non-finite,
//! otherwise a string. Cells of the column `id` are never numbers.
std::string json_of_cell(std::string_view column, std::string_view cell) {
  const bool number = column != "id" && cell.find_first_of("0123456789") != std::string_view::npos &&
                      nlohmann::json::accept(cell.begin(), cell.end());
  if (number) {
    return std::string(cell);
  }
  return cell.empty() || cell == "nan" || cell == "inf" || cell == "-inf"
             ? "null"
             : nlohmann::json(cell).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

//! Calls work(line) for each line of a text.
template <class Work>
void for_each_line(std::string_view text, const Work& work) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    work(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

std::string json_of_table(std::string_view csv) {
  std::vector<std::string_view> columns;
  std::string json = "[";
  bool first = true;
  for_each_line(csv, [&](std::string_view line) {
    const std::vector<std::string_view> cells = cells_of(line);
    if (columns.empty()) {
      columns = cells;
      return;
    }
    json += first ? "\n  {" : ",\n  {";
    first = false;
    for (std::size_t i = 0; i < std::min(columns.size(), cells.size()); ++i) {
      json += fmt::format("{}\"{}\": {}", i == 0 ? "" : ", ", columns[i], json_of_cell(columns[i], cells[i]));
    }
    json += '}';
  });
  return json + "\n]\n";
}

std::string tabs_of_table(std::string_view csv, const std::filesystem::path& table) {
  if (csv.find('\t') != std::string_view::npos) {
    throw Error(table.string(), "cannot use tabs as separators, because an id contains a tab",
                "choose a name that ends in .csv");
  }
  std::string text(csv);
  std::ranges::replace(text, ',', '\t');
  return text;
}

}  // namespace

void require_other_file(const std::string& option, const std::filesystem::path& written,
                        std::initializer_list<std::filesystem::path> read) {
  for (const std::filesystem::path& each : read) {
    // Files that do not exist are not equivalent.
    std::error_code not_there;
    if (std::filesystem::equivalent(written, each, not_there)) {
      throw UsageError(option + " " + written.string(), "is also the input file, which would be overwritten",
                       "choose another name");
    }
  }
}

void require_output_file(const std::string& option, const std::filesystem::path& written,
                         std::initializer_list<std::filesystem::path> read) {
  std::error_code problem;
  const std::filesystem::path folder = written.parent_path();
  if (!folder.empty() && !std::filesystem::is_directory(folder, problem)) {
    throw Error(option + " " + written.string(), "cannot be written: the folder " + folder.string() + " does not exist",
                "create it, or choose another name");
  }
  require_other_file(option, written, read);
}

void require_other_png(const std::string& option, const std::filesystem::path& written,
                       std::initializer_list<std::filesystem::path> read) {
  if (!written.empty() && lower_ending(written) != ".png") {
    throw UsageError(option + " " + written.string(), "does not end in .png", "choose a name that ends in .png");
  }
  require_output_file(option, written, read);
}

void require_table_ending(const std::string& option, const std::filesystem::path& table) {
  const std::string ending = lower_ending(table);
  if (!ending.empty() && ending != ".csv" && ending != ".txt" && ending != ".tsv" && ending != ".json") {
    throw UsageError(option + " " + table.string(), "has an unsupported extension",
                     "choose a name that ends in .csv, .tsv or .json");
  }
}

void write_table_in_parts(const std::filesystem::path& table,
                          const std::function<void(const TablePartWriter& write)>& compute) {
  const std::string ending = lower_ending(table);
  if (ending == ".json" || ending == ".tsv") {
    std::string csv;
    compute([&](std::string_view part) { csv += part; });
    return write_table(table, csv);
  }
  write_atomically(table, [&](const std::filesystem::path& partial) {
    std::ofstream file(partial, std::ios::binary);
    compute([&](std::string_view part) { file.write(part.data(), static_cast<std::streamsize>(part.size())); });
    file.close();
    if (!file) {
      throw Error(table.string(), std::string("cannot be written: ") + std::strerror(errno),
                  "check the folder, its permissions and the free space");
    }
  });
}

void write_table(const std::filesystem::path& table, std::string_view csv) {
  const std::string ending = lower_ending(table);
  if (ending == ".json") {
    write_text_atomically(table, json_of_table(csv));
  } else if (ending == ".tsv") {
    write_text_atomically(table, tabs_of_table(csv, table));
  } else {
    write_text_atomically(table, csv);
  }
}

}  // namespace ergodome
