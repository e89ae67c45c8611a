#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <istream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ergodome {

//! One line of a table of numbers while it is taken apart.
struct TableLine {
  std::vector<std::string_view> cells;  //!< of text that the table keeps until its next line is read
  std::string place;                    //!< file and line, for messages

  //! A cell without its spaces and quotes; empty where the line is too short.
  [[nodiscard]] std::string_view cell(std::size_t column) const {
    return column < cells.size() ? cells[column] : std::string_view{};
  }

  //! A cell's finite number; throws Error, which calls it `name`, where there is none.
  [[nodiscard]] double number(std::size_t column, std::string_view name) const;
};

//! Reads a table of numbers line by line: CSV whose first line names the columns. Lines are at most 64 KiB, rows at most 50 million; Error
//! tells what is beyond.
class NumberTable {
 public:
  //! Reads the first line; `file` is how messages call the table.
  NumberTable(std::istream& stream, std::string file);

  //! A column's number by its name; throws Error where two have it.
  [[nodiscard]] std::optional<std::size_t> find(std::string_view name) const;
  //! The same; throws Error where there is none.
  [[nodiscard]] std::size_t need(std::string_view name) const;

  //! Takes the next line that is not empty; false at the end. Throws Error where it has more cells than the first line names.
  bool next(TableLine& line);

 private:
  std::istream& stream_;
  std::string file_;
  std::vector<std::string> names_;
  std::string text_;
  std::size_t line_number_ = 1;
  std::size_t rows_ = 0;
};

//! Opens a table's file; throws Error, which says that it should be `what` ("a table of rays"), where it cannot be read.
std::ifstream open_table(const std::filesystem::path& path, std::string_view what);

}  // namespace ergodome
