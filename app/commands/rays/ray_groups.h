#pragma once

#include <functional>
#include <string>
#include <vector>

#include "content/tables/ray_table.h"

namespace ergodome {

//! Rows in an order in which those of one camera stand together, cameras as they come first.
struct GroupedRows {
  std::vector<RayRow> rows;
  std::vector<std::size_t> place;  //!< where each of them stood before
};
GroupedRows grouped_by_camera(std::vector<RayRow> rows);

//! Lines, one for each grouped row, as one text in the order that the rows had before.
std::string joined_in_place(const std::vector<std::string>& lines, const std::vector<std::size_t>& place);

//! Returns what `trace` and `edge` say of their tables in --help: columns, axes, units.
std::string ray_table_help();

//! Calls work(begin, end) for each run of rows with one camera; runs are bounded so that progress and Ctrl-C work. Throws Error when stopped.
void for_each_camera(const std::vector<RayRow>& rows, const std::function<void(std::size_t, std::size_t)>& work);

}  // namespace ergodome
