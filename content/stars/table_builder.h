#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "content/stars/star_rows.h"
#include "content/stars/table_columns.h"
#include "kernels/core/error.h"

namespace ergodome {

//! Builds a star catalog from the cells and rows of a CSV parser. Stores the first problem, because
//! exceptions must not pass through the parser's C code; check() throws it.
class TableBuilder {
 public:
  explicit TableBuilder(std::string file) : file_(std::move(file)), rows_(file_) {}

  //! Sets the character between cells, and the units of columns that comments state. Call it before
  //! the header is parsed.
  void begin(char separator, UnitsByName units);

  void take_cell(std::string_view cell);

  //! Ends a row. `end` is the character that ended it. A carriage return is not counted as the end
  //! of a line, because a line feed follows it.
  void end_row(int end);

  //! Counts a line that is not passed to the parser.
  void skip_line(int end) { line_ += end != '\r' ? 1 : 0; }

  //! Returns true outside rows, and so outside quotes.
  [[nodiscard]] bool is_between_rows() const { return between_rows_; }
  void begin_row() { between_rows_ = false; }

  //! Throws the first problem, if any.
  void check() const;

  StarCatalogue finish();

  void fail(const std::string& problem, const std::string& remedy);

 private:
  void count_lines(std::string_view cell);
  void take_row();
  void end_header();
  [[nodiscard]] bool repeats_header() const;

  std::string file_;
  StarRows rows_;
  std::size_t line_ = 1;          //!< number of the current row's first line
  std::size_t lines_in_row_ = 0;  //!< number of lines that ended within the row's cells
  std::size_t cell_ = 0;
  bool in_header_ = true;
  bool between_rows_ = true;
  //! True once a row of stars has begun: after the header, the row of units and the row of dashes.
  bool rows_begun_ = false;
  bool only_dashes_ = true;  //!< the cells of this row contain only dashes
  char separator_ = ',';
  UnitsByName units_;
  std::vector<std::string> names_;  //!< names of the header's columns, at most `max_columns`
  std::size_t named_ = 0;           //!< number of columns in the header
  RowCells cells_;
  std::optional<Error> problem_;
};

}  // namespace ergodome
