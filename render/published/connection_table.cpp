#include "render/published/connection_table.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "kernels/core/error.h"
#include "kernels/spacetime/schwarzschild/connection_table.h"

namespace ergodome {

namespace {

void check(const ConnectionTableSettings& settings) {
  const std::string location = "table of connecting rays";
  const auto is_range = [](double nearest, double farthest) {
    return nearest > 2.0 && farthest >= nearest && farthest <= farthest_of_table;
  };
  if (!is_range(settings.r_nearest, settings.r_farthest) || settings.r_nearest == settings.r_farthest ||
      !is_range(settings.r_observer_nearest, settings.r_observer_farthest)) {
    throw Error(location, "has invalid radii", "choose radii above 2 and up to 1e6 (M = 1), the smallest first");
  }
  const bool one_observer = settings.r_observer_nearest == settings.r_observer_farthest;
  if (one_observer ? settings.layers != 1 : settings.layers < 4) {
    throw Error(location, "has a wrong number of layers",
                "choose 1 if all observers have the same radius, otherwise at least 4");
  }
  if (settings.orders < 2 || settings.orders > max_connection_orders) {
    throw Error(location, "has an unsupported number of orders", "choose 2 to 16");
  }
  if (settings.rows < 4 || settings.columns < 4 || settings.rows > 8192 || settings.columns > 8192 ||
      0.5 * settings.orders * settings.layers * settings.rows * settings.columns > 2e8) {
    throw Error(location, "has an unsupported size", "choose 4 to 8192 rows and columns, and at most 2e8 nodes");
  }
}

//! Returns the number of Chebyshev points, 12 to 400, for an interpolation error of 1e-9 in the
//! range of u = 1/r from u_low to u_high. The interpolated functions are smooth except at u = 0 and
//! u = 1/2. The error decreases faster the larger the ellipse around the range can be without
//! containing either of these (Trefethen, Approximation Theory and Approximation Practice, ch. 8).
int fan_rows_for(double u_low, double u_high) {
  const double half = 0.5 * (u_high - u_low);
  const double nearest = std::min(u_low, 0.5 - u_high) / half;
  const double ellipse = 1.0 + nearest + std::sqrt(nearest * (2.0 + nearest));
  return std::clamp(static_cast<int>(std::ceil(std::log(1e9) / std::log(ellipse))), 12, 400);
}

}  // namespace

ConnectionTable::ConnectionTable(const ConnectionTableSettings& settings) {
  check(settings);
  grid_.u_low = 1.0 / settings.r_farthest;
  grid_.u_high = 1.0 / settings.r_nearest;
  grid_.u_observer_low = 1.0 / settings.r_observer_farthest;
  grid_.u_observer_high = 1.0 / settings.r_observer_nearest;
  grid_.rows = settings.rows;
  grid_.orders = settings.orders;
  grid_.columns = settings.orders * settings.columns;
  grid_.layers = settings.layers;
  grid_.fan_rows = fan_rows_for(grid_.u_low, grid_.u_high);
  const auto layers = static_cast<std::size_t>(grid_.layers);
  const auto rows = static_cast<std::size_t>(grid_.rows);
  std::vector<UnroundedNode> fan(layers * static_cast<std::size_t>(grid_.fan_rows) *
                                 static_cast<std::size_t>(fan_columns(grid_)));
  std::vector<UnroundedNode> spread(layers * rows * static_cast<std::size_t>(fan_columns(grid_)));
  nodes_.resize(layers * rows * (static_cast<std::size_t>(grid_.columns) + 1));
  make_connection_table({grid_, fan.data(), spread.data(), nodes_.data()});
}

}  // namespace ergodome
