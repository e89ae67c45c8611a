#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

#include "content/stars/star_catalogue.h"
#include "content/stars/table_columns.h"

namespace ergodome {

//! The cells of a row that are read, by quantity.
using RowCells = std::array<std::string, quantity_count>;

//! Makes stars from the rows of a table. Decides at the end, when all values are known, whether a
//! column `ra` is in hours or in degrees.
class StarRows {
 public:
  explicit StarRows(std::string file) : file_(std::move(file)) {}

  //! Sets the columns and the character between cells, before the first row.
  void begin(TableColumns columns, char separator);

  //! Adds the star of a row; counts the row as skipped if it has no position or magnitude, or is
  //! that of the Sun. Throws Error for cells that are not numbers, and for values out of range.
  void take(const RowCells& cells, std::size_t line);

  //! Checks whether a row contains units, and if so applies them to the columns. Returns true if it
  //! does. Throws Error for unsupported units.
  bool take_units(const RowCells& cells, std::size_t line);

  //! Records skipped rows of the table.
  void leave_out(const RowsLeftOut& rows);

  [[nodiscard]] const TableColumns& columns() const { return columns_; }

  //! Returns the catalog, brightest star first.
  StarCatalogue finish();

 private:
  struct Coordinates {
    double ra = 0.0;  //!< right ascension: [deg] if sexagesimal, otherwise in the column's unit
    double dec_deg = 0.0;
  };

  [[nodiscard]] std::string location(std::size_t line) const;
  [[noreturn]] void refuse(const std::string& cell, Quantity quantity, std::size_t line) const;
  //! Returns a cell without surrounding spaces and with a decimal point in place of a comma; empty
  //! for words such as null.
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
  bool sexagesimal_ = false;  //!< a right ascension with minutes was read
  bool decimal_ = false;      //!< a right ascension without minutes was read
  double largest_ra_ = 0.0;   //!< maximum absolute decimal right ascension
  //! Quantities from which at least one star's magnitude or color was computed.
  std::array<bool, quantity_count> used_{};
  StarCatalogue catalogue_;
};

}  // namespace ergodome
