#include "content/tables/number_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "kernels/core/error.h"

namespace ergodome {

namespace {

constexpr std::size_t longest_line = 65'536;
constexpr std::size_t max_rows = 50'000'000;

//! Reads the next line without its end. A line that is too long is cut after one character more
//! than the maximum.
bool read_line(std::istream& stream, std::string& line) {
  line.resize(longest_line + 2);
  stream.getline(line.data(), static_cast<std::streamsize>(line.size()));
  const auto taken = static_cast<std::size_t>(stream.gcount());
  const bool cut = stream.fail() && taken == longest_line + 1;
  if (stream.fail() && !cut) {
    return false;
  }
  if (cut) {
    stream.clear();
  }
  line.resize(cut || stream.eof() ? taken : taken - 1);
  return true;
}

std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> cells;
  while (true) {
    const std::size_t comma = line.find(',');
    std::string_view cell = line.substr(0, comma);
    while (!cell.empty() && (cell.front() == ' ' || cell.front() == '"')) {
      cell.remove_prefix(1);
    }
    while (!cell.empty() && (cell.back() == ' ' || cell.back() == '"' || cell.back() == '\r')) {
      cell.remove_suffix(1);
    }
    cells.push_back(cell);
    if (comma == std::string_view::npos) {
      return cells;
    }
    line.remove_prefix(comma + 1);
  }
}

}  // namespace

double TableLine::number(std::size_t column, std::string_view name) const {
  std::string_view text = cell(column);
  if (!text.empty() && text.front() == '+') {
    text.remove_prefix(1);  // from_chars does not accept a plus sign
  }
  double value = 0.0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  // Numbers below the smallest double count as zero.
  const bool tiny = problem == std::errc::result_out_of_range && text.find("e-") != std::string_view::npos;
  if (tiny) {
    return 0.0;
  }
  if (problem != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) {
    throw Error(location, fmt::format("{} is \"{}\", not a number", name, text.substr(0, 40)), "write a finite number");
  }
  return value;
}

NumberTable::NumberTable(std::istream& stream, std::string file) : stream_(stream), file_(std::move(file)) {
  if (!read_line(stream_, text_) || text_.size() > longest_line) {
    throw Error(file_, "has no header line", "name the columns in the first line");
  }
  if (text_.starts_with("\xEF\xBB\xBF")) {
    text_.erase(0, 3);  // spreadsheets mark UTF-8 with these bytes
  }
  const std::vector<std::string_view> names = split(text_);
  names_.assign(names.begin(), names.end());
}

std::optional<std::size_t> NumberTable::find(std::string_view name) const {
  const auto found = std::ranges::find(names_, name);
  if (found == names_.end()) {
    return std::nullopt;
  }
  if (std::find(found + 1, names_.end(), name) != names_.end()) {
    throw Error(file_ + ":1", fmt::format("has two columns {}", name), "remove or rename one of them");
  }
  return static_cast<std::size_t>(found - names_.begin());
}

std::size_t NumberTable::need(std::string_view name) const {
  const auto column = find(name);
  if (!column) {
    throw Error(file_ + ":1", fmt::format("has no column {}", name), "name the columns in the first line");
  }
  return *column;
}

bool NumberTable::next(TableLine& line) {
  while (read_line(stream_, text_)) {
    ++line_number_;
    if (text_.empty() || text_ == "\r") {
      continue;
    }
    line.location = fmt::format("{}:{}", file_, line_number_);
    if (text_.size() > longest_line || rows_ >= max_rows) {
      throw Error(line.location, "exceeds the limits of a table: lines of 64 KiB, 50 million rows", "split the file");
    }
    ++rows_;
    line.cells = split(text_);
    const auto extra = line.cells.begin() + static_cast<std::ptrdiff_t>(std::min(names_.size(), line.cells.size()));
    if (std::any_of(extra, line.cells.end(), [](std::string_view cell) { return !cell.empty(); })) {
      throw Error(line.location,
                  fmt::format("has {} cells, but the first line names {} columns", line.cells.size(), names_.size()),
                  "name every column, and write numbers with a decimal point, not a comma");
    }
    return true;
  }
  return false;
}

std::ifstream open_table(const std::filesystem::path& path, std::string_view what) {
  std::error_code problem;
  if (!std::filesystem::is_regular_file(path, problem)) {
    throw Error(path.string(), "does not exist or cannot be read", fmt::format("give the path of {} (.csv)", what));
  }
  std::ifstream stream(path, std::ios::binary);
  if (!stream) {
    throw Error(path.string(), "cannot be read", "check its permissions");
  }
  return stream;
}

}  // namespace ergodome
