#include "content/stars/table_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace ergodome {

namespace {

constexpr std::size_t max_columns = 4096;

bool is_dashes(std::string_view cell) { return cell.find_first_not_of("- ") == std::string_view::npos; }

}  // namespace

void TableBuilder::begin(char separator, UnitsByName units) {
  separator_ = separator;
  units_ = std::move(units);
}

void TableBuilder::take_cell(std::string_view cell) {
  if (problem_) {
    return;
  }
  if (cell.find('\n') != std::string_view::npos) {
    count_lines(cell);
  }
  only_dashes_ = only_dashes_ && is_dashes(cell);
  if (in_header_) {
    if (names_.size() < max_columns) {
      names_.emplace_back(cell);
    }
  } else if (const auto& quantities = rows_.columns().quantities; cell_ < quantities.size() && quantities[cell_]) {
    cells_[*quantities[cell_]] = cell;
  } else if (cell_ >= named_ && !cell.empty()) {
    fail(fmt::format("has more cells than the {} columns that the first line names", named_),
         separator_ == ' ' ? "save it as CSV: cells of a table that is separated by spaces cannot contain spaces"
                           : "name every column, and put cells with commas in quotation marks");
  }
  ++cell_;
}

void TableBuilder::end_row(int end) {
  if (!problem_ && cell_ > 0) {
    try {
      in_header_ ? end_header() : take_row();
    } catch (const Error& problem) {
      problem_ = problem;
    }
  }
  line_ += lines_in_row_ + (end != '\r' ? 1 : 0);
  lines_in_row_ = 0;
  cell_ = 0;
  only_dashes_ = true;
  between_rows_ = true;
  std::ranges::for_each(cells_, [](std::string& cell) { cell.clear(); });
}

void TableBuilder::end_header() {
  in_header_ = false;
  named_ = cell_;
  rows_.begin(choose_columns(names_, units_, fmt::format("{}:{}", file_, line_)), separator_);
}

//! Returns true if a row repeats the header. VizieR and concatenated files do so where a second
//! table begins.
bool TableBuilder::repeats_header() const {
  const TableColumns& columns = rows_.columns();
  return cells_[right_ascension] == columns.names[right_ascension] && cells_[declination] == columns.names[declination];
}

void TableBuilder::take_row() {
  // Below its header, VizieR writes a row of units and a row of dashes, which are skipped.
  const bool dashes = only_dashes_ && cells_[right_ascension].size() > 1;
  if (!rows_begun_ && (dashes || rows_.take_units(cells_, line_))) {
    return;
  }
  rows_begun_ = true;
  if (repeats_header()) {
    return fail("repeats the column names, so a second table begins here", "split the file into one file per table");
  }
  if (separator_ == ' ' && cell_ != named_) {
    return fail(fmt::format("has {} cells, but the first line names {} columns", cell_, named_),
                "save it as CSV: cells of a table that is separated by spaces cannot be empty or contain spaces");
  }
  rows_.take(cells_, line_);
}

//! Counts the lines that end within a quoted cell. If the cell also contains at least as many
//! separators as that number of complete rows, its closing quote is missing, and whole rows became
//! part of the cell; they are reported as skipped. An ordinary cell may contain line breaks, but
//! not so many separators.
void TableBuilder::count_lines(std::string_view cell) {
  const auto lines = static_cast<std::size_t>(std::ranges::count(cell, '\n'));
  const auto separators = static_cast<std::size_t>(std::ranges::count(cell, separator_));
  if (!in_header_ && named_ > 1 && separators >= (named_ - 1) * lines) {
    rows_.leave_out({"inside quotation marks that are closed on another line", lines, line_ + lines_in_row_, false});
  }
  lines_in_row_ += lines;
}

void TableBuilder::check() const {
  if (problem_) {
    throw Error(*problem_);
  }
}

StarCatalogue TableBuilder::finish() {
  check();
  if (in_header_) {
    throw Error(file_, "is empty", "name the columns in the first line, for example ra_deg,dec_deg,v_mag,b_v");
  }
  return rows_.finish();
}

void TableBuilder::fail(const std::string& problem, const std::string& remedy) {
  if (!problem_) {
    problem_ = Error(fmt::format("{}:{}", file_, line_), problem, remedy);
  }
}

}  // namespace ergodome
