#include "calibration/warps/warp_mesh.h"

#include <fmt/format.h>

#include "kernels/core/error.h"

namespace ergodome {

void check_mesh_size(long long columns, long long rows, const std::string& location) {
  if (columns < 2 || rows < 2) {
    throw Error(location, fmt::format("is a mesh of {} x {} nodes, too small", columns, rows),
                "use at least 2 x 2 nodes");
  }
  if (columns > max_mesh_side || rows > max_mesh_side ||
      static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows) > max_mesh_nodes) {
    throw Error(location, fmt::format("is a mesh of {} x {} nodes, too large", columns, rows),
                fmt::format("use at most {} nodes a side and {} in total", max_mesh_side, max_mesh_nodes));
  }
}

}  // namespace ergodome
