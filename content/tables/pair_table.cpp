#include "content/tables/pair_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "content/tables/number_table.h"
#include "kernels/core/angles.h"
#include "kernels/core/error.h"
#include "kernels/spacetime/schwarzschild/connecting_ray.h"

namespace ergodome {

namespace {

//! Tolerance for angles at the end of their range that are written with fewer digits than a double
//! has.
constexpr double slack = 1e-9;

void check_radius(double r, std::string_view name, const std::string& location) {
  if (!(r > 2.0 && r <= 1e12)) {
    throw Error(location, fmt::format("{} is {:.9g}, outside 2 to 1e12", name, r),
                "choose a radius outside the horizon, which is at 2 (M = 1)");
  }
}

PairRow pair_of(const TableLine& line, const std::size_t (&columns)[4]) {
  PairRow row;
  row.r_observer = line.number(columns[0], "r_obs");
  row.r = line.number(columns[1], "r");
  row.phi = line.number(columns[2], "phi");
  const double order = line.number(columns[3], "order");
  check_radius(row.r_observer, "r_obs", line.location());
  check_radius(row.r, "r", line.location());
  if (!(order >= 1.0 && order <= highest_order && order == std::floor(order))) {
    throw Error(line.location(), fmt::format("order is {:.9g}", order),
                fmt::format("choose 1 (direct image), 2 (around the other side), ... up to {}", highest_order));
  }
  row.order = static_cast<int>(order);
  const double maximum = std::max(2, row.order) * pi;
  if (!(row.phi >= 0.0 && row.phi <= maximum + slack)) {
    throw Error(line.location(), fmt::format("phi is {:.9g}", row.phi),
                fmt::format("choose an azimuth from 0 to {:.9g} for order {}", maximum, row.order));
  }
  row.angle = image_angle(row.phi, row.order);
  if (const char* reason = why_not_connected(row.r_observer, row.r, row.angle)) {
    throw Error(line.location(), fmt::format("no light ray of order {} exists: {}", row.order, reason),
                "change r_obs, r, phi or order in this line");
  }
  row.location = line.location();
  row.text = fmt::format("{},{},{},{}", line.cell(columns[0]), line.cell(columns[1]), line.cell(columns[2]),
                         line.cell(columns[3]));
  return row;
}

}  // namespace

std::vector<PairRow> read_pair_table(std::istream& stream, const std::string& file) {
  NumberTable table(stream, file);
  const std::size_t columns[4] = {table.need("r_obs"), table.need("r"), table.need("phi"), table.need("order")};
  std::vector<PairRow> rows;
  for (TableLine line; table.next(line);) {
    rows.push_back(pair_of(line, columns));
  }
  return rows;
}

std::vector<PairRow> read_pair_table(const std::filesystem::path& path) {
  std::ifstream stream = open_table(path, "a table of pairs");
  return read_pair_table(stream, path.string());
}

}  // namespace ergodome
