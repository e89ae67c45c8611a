#pragma once

#include <functional>
#include <string>
#include <vector>

#include "content/tables/ray_table.h"

namespace ergodome {

//! Table rows grouped by camera. The groups are in the order of their first rows in the table.
struct GroupedRows {
  std::vector<RayRow> rows;
  std::vector<std::size_t> position;  //!< original index of each row
};
GroupedRows grouped_by_camera(std::vector<RayRow> rows);

//! Joins lines, one for each grouped row, in the original order of the rows. `position`:
//! GroupedRows::position.
std::string joined_in_place(const std::vector<std::string>& lines, const std::vector<std::size_t>& position);

//! Returns the description of tables in the help of `trace` and `edge`: columns, axes, units.
std::string ray_table_help();

//! Calls work(begin, end) for each run of consecutive rows with one camera, [begin, end). Runs of
//! more than a million rows are split so that progress and Ctrl-C work. Throws Error when
//! interrupted.
void for_each_camera(const std::vector<RayRow>& rows, const std::function<void(std::size_t, std::size_t)>& work);

}  // namespace ergodome
