#pragma once

#include <functional>
#include <string>

#include "content/tables/ray_table.h"
#include "kernels/launch/large_memory.h"
#include "kernels/spacetime/kerr/camera_station.h"

namespace ergodome {

//! Sorts the rows of a table by camera; groups keep the order of their first rows. Rows with equal cameras then share one
//! index. Returns true if the order did not change.
bool group_by_camera(RayTable& table);

//! A table as text: a header line and the lines of its rows.
struct TableText {
  LargeText text;
  LargeVector<std::size_t> begins;  //!< where the line of each row begins
};

//! Returns the text of a table with one line for each grouped row, in the original order of the
//! rows. Returns the text unchanged if the lines were already passed on (`begins` is empty).
LargeText text_in_order(TableText table, const RayRows& rows);

//! Returns the position and the motion of a camera, for kernels.
CameraStation station_of(const RayCamera& camera);

//! Returns the description of tables in the help of `trace` and `edge`: columns, axes, units.
std::string ray_table_help();

//! Calls work(begin, end) for each run of consecutive rows with one camera, [begin, end). Runs of
//! more than a million rows are split so that progress and Ctrl-C work. Throws Error when
//! interrupted.
void for_each_camera(const RayRows& rows, const std::function<void(std::size_t, std::size_t)>& work);

}  // namespace ergodome
