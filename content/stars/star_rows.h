#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

#include "content/stars/star_catalogue.h"
#include "content/stars/table_columns.h"

namespace ergodome {

//! The cells of one row that are read, by quantity.
using RowCells = std::array<std::string, quantity_count>;

//! Makes stars of a table's rows. Whether a column `ra` is in hours or in degrees is decided at the
//! end, when all values are known.
class StarRows {
 public:
  explicit StarRows(std::string file) : file_(std::move(file)) {}

  //! Sets the columns and the character between cells, before the first row.
  void begin(TableColumns columns, char separator);

  //! Takes a row. Throws Error for cells that are not numbers, and for values out of range.
  void take(const RowCells& cells, std::size_t line);

  //! Takes a row as the units of the columns if it is one, and says whether it was. Throws Error
  //! for units that are not supported.
  bool take_units(const RowCells& cells, std::size_t line);

  //! Counts rows of which no star is made.
  void leave_out(const RowsLeftOut& rows);

  [[nodiscard]] const TableColumns& columns() const { return columns_; }

  //! Returns the catalogue, brightest star first.
  StarCatalogue finish();

 private:
  struct Coordinates {
    double ra = 0.0;  //!< [deg] if sexagesimal, or else in the column's unit
    double dec_deg = 0.0;
  };

  [[nodiscard]] std::string place(std::size_t line) const;
  [[noreturn]] void refuse(const std::string& cell, Quantity quantity, std::size_t line) const;
  //! Returns a cell with a point for a decimal comma, and without spaces around it; empty for words
  //! such as null.
  [[nodiscard]] std::string number_text(const std::string& cell) const;
  [[nodiscard]] double number(const RowCells& cells, Quantity quantity, std::size_t line) const;
  Coordinates coordinates(const RowCells& cells, std::size_t line);
  double right_ascension_of(const std::string& text, const std::string& cell, std::size_t line);
  [[nodiscard]] double declination_of(const std::string& text, const std::string& cell, std::size_t line) const;
  [[nodiscard]] double magnitude(const RowCells& cells, std::size_t line);
  [[nodiscard]] double colour(const RowCells& cells, std::size_t line);
  void decide_unit();
  [[nodiscard]] std::string how_read() const;

  std::string file_;
  TableColumns columns_;
  char separator_ = ',';
  bool sexagesimal_ = false;                 //!< right ascensions with minutes were seen
  bool decimal_ = false;                     //!< right ascensions without were seen
  double largest_ra_ = 0.0;                  //!< of decimal ones, without sign
  std::array<bool, quantity_count> used_{};  //!< quantities that gave a magnitude or a colour
  StarCatalogue catalogue_;
};

}  // namespace ergodome
