#pragma once

#include <functional>
#include <string>

#include "content/tables/ray_table.h"
#include "kernels/launch/large_memory.h"

namespace ergodome {

//! Table rows grouped by camera. The groups are in the order of their first rows in the table.
struct GroupedRows {
  RayRows rows;
  LargeVector<std::size_t> position;  //!< original index of each row; empty if the rows kept their order
};
GroupedRows grouped_by_camera(RayRows rows);

using LargeText = std::basic_string<char, std::char_traits<char>, LargeAllocator<char>>;

//! A table as text: a header line and the lines of its rows.
struct TableText {
  LargeText text;
  LargeVector<std::size_t> begins;  //!< where the line of each row begins
};

//! Returns the text of a table with one line for each grouped row, in the original order of the
//! rows. `position`: GroupedRows::position.
LargeText text_in_place(TableText table, const LargeVector<std::size_t>& position);

//! Returns the description of tables in the help of `trace` and `edge`: columns, axes, units.
std::string ray_table_help();

//! Calls work(begin, end) for each run of consecutive rows with one camera, [begin, end). Runs of
//! more than a million rows are split so that progress and Ctrl-C work. Throws Error when
//! interrupted.
void for_each_camera(const RayRows& rows, const std::function<void(std::size_t, std::size_t)>& work);

}  // namespace ergodome
