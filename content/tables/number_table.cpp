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

//! Returns a cell without surrounding spaces and quotes.
std::string_view cell_without_blanks(std::string_view cell) {
  while (!cell.empty() && (cell.front() == ' ' || cell.front() == '"')) {
    cell.remove_prefix(1);
  }
  while (!cell.empty() && (cell.back() == ' ' || cell.back() == '"' || cell.back() == '\r')) {
    cell.remove_suffix(1);
  }
  return cell;
}

//! Replaces `cells` by the cells of a line.
void split(std::string_view line, std::vector<std::string_view>& cells) {
  cells.clear();
  for (std::size_t begin = 0, at = 0; at <= line.size(); ++at) {
    if (at == line.size() || line[at] == ',') {
      cells.push_back(cell_without_blanks(line.substr(begin, at - begin)));
      begin = at + 1;
    }
  }
}

}  // namespace

std::string TableLine::location() const { return fmt::format("{}:{}", file, number_in_file); }

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
    throw Error(location(), fmt::format("{} is \"{}\", not a number", name, text.substr(0, 40)),
                "write a finite number");
  }
  return value;
}

NumberTable::NumberTable(std::istream& stream, std::string file)
    : stream_(stream), file_(std::move(file)), block_(4 * longest_line) {
  const auto first = read_line();
  if (!first || first->size() > longest_line) {
    throw Error(file_, "has no header line", "name the columns in the first line");
  }
  std::string_view text = *first;
  if (text.starts_with("\xEF\xBB\xBF")) {
    text.remove_prefix(3);  // spreadsheets mark UTF-8 with these bytes
  }
  std::vector<std::string_view> names;
  split(text, names);
  names_.assign(names.begin(), names.end());
}

std::optional<std::string_view> NumberTable::read_line() {
  for (std::size_t searched = 0;;) {
    const std::string_view text(block_.data() + begin_, end_ - begin_);
    const std::size_t length = std::min(text.find('\n', searched), text.size());
    if (length < text.size() || length > longest_line) {
      begin_ += length + (length < text.size() ? 1 : 0);
      return text.substr(0, std::min(length, longest_line + 1));
    }
    if (!stream_) {
      begin_ = end_;
      return text.empty() ? std::nullopt : std::optional(text);
    }
    searched = length;
    end_ = static_cast<std::size_t>(std::copy(text.begin(), text.end(), block_.begin()) - block_.begin());
    begin_ = 0;
    stream_.read(block_.data() + end_, static_cast<std::streamsize>(block_.size() - end_));
    end_ += static_cast<std::size_t>(stream_.gcount());
  }
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
  while (const auto text = read_line()) {
    ++line_number_;
    if (text->empty() || *text == "\r") {
      continue;
    }
    line.file = file_;
    line.number_in_file = line_number_;
    if (text->size() > longest_line || rows_ >= max_rows) {
      throw Error(line.location(), "exceeds the limits of a table: lines of 64 KiB, 50 million rows", "split the file");
    }
    ++rows_;
    split(*text, line.cells);
    const auto extra = line.cells.begin() + static_cast<std::ptrdiff_t>(std::min(names_.size(), line.cells.size()));
    if (std::any_of(extra, line.cells.end(), [](std::string_view cell) { return !cell.empty(); })) {
      throw Error(line.location(),
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
