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

//! Takes cells and rows from a CSV parser. It must not throw through the parser's frames: the first
//! problem is kept.
class TableBuilder {
 public:
  explicit TableBuilder(std::string file) : file_(std::move(file)), rows_(file_) {}

  //! Sets the character between cells, and units of columns that comments told, before the header.
  void begin(char separator, UnitsByName units);

  void take_cell(std::string_view cell);

  //! `end` is the character that ended it; a carriage return has a line feed behind it.
  void end_row(int end);

  //! Counts a line that is not given to the parser.
  void skip_line(int end) { line_ += end != '\r' ? 1 : 0; }

  //! True outside of rows, and so outside of quotes.
  [[nodiscard]] bool is_between_rows() const { return between_rows_; }
  void begin_row() { between_rows_ = false; }

  //! Throws the first problem.
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
  std::size_t line_ = 1;          //!< where the row begins
  std::size_t lines_in_row_ = 0;  //!< that cells of it have ended
  std::size_t cell_ = 0;
  bool in_header_ = true;
  bool between_rows_ = true;
  bool rows_begun_ = false;  //!< behind the header, the units and the dashes
  bool only_dashes_ = true;  //!< in the cells of this row
  char separator_ = ',';
  UnitsByName units_;
  std::vector<std::string> names_;  //!< of the header, as far as they are kept
  std::size_t named_ = 0;           //!< columns of the header
  RowCells cells_;
  std::optional<Error> problem_;
};

}  // namespace ergodome
