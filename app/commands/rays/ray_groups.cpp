#include "app/commands/rays/ray_groups.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include "app/cli/interrupt.h"
#include "app/cli/progress.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

//! Returns the values that distinguish cameras.
auto camera_of(const RayRow& row) {
  return std::tuple(row.spacetime.spin, row.r, row.theta, row.motion, row.velocity.x, row.velocity.y, row.velocity.z);
}

bool same_camera(const RayRow& a, const RayRow& b) {
  return a.spacetime.spin == b.spacetime.spin && a.r == b.r && a.theta == b.theta && a.motion == b.motion &&
         a.velocity.x == b.velocity.x && a.velocity.y == b.velocity.y && a.velocity.z == b.velocity.z;
}

}  // namespace

std::string ray_table_help() {
  return "Columns of the table of rays (one row per ray; the first row names the columns; others are ignored; M = 1):\n"
         "  a or spin             spin of the hole, -1 to 1\n"
         "  r                     radius of the camera [M]\n"
         "  theta or theta_deg    angle from the spin axis [rad or degrees]: 0 at the pole, pi/2 at the equator\n"
         "  observer              motion of the camera: zamo, static, geodesic, retrograde, rain, boost or rain_boost\n"
         "  beta_r, beta_theta, beta_phi   for boost and rain_boost: velocity relative to the zamo or the rain, below "
         "1\n"
         "  n_r, n_theta, n_phi   direction in which the light is seen, in the observer's frame; any length but 0\n"
         "  id                    any text; repeated in the results (default: the row's number, from 0)\n"
         "Axes: e_r away from the hole, e_theta toward larger theta (south), e_phi in the direction of rotation of "
         "a hole\n"
         "with positive spin. The camera is at phi = 0.\n"
         "The extension of --out chooses the format: .csv, .tsv (tabs) or .json (an array of objects).";
}

GroupedRows grouped_by_camera(RayRows rows) {
  std::map<decltype(camera_of(rows[0])), std::uint32_t> number_of;
  LargeVector<std::uint32_t> camera(rows.size());
  bool are_grouped = true;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (i > 0 && same_camera(rows[i - 1], rows[i])) {
      camera[i] = camera[i - 1];
      continue;
    }
    const auto [found, is_new] =
        number_of.try_emplace(camera_of(rows[i]), static_cast<std::uint32_t>(number_of.size()));
    camera[i] = found->second;
    are_grouped = are_grouped && is_new;
  }
  GroupedRows grouped;
  if (are_grouped) {
    grouped.rows = std::move(rows);
    return grouped;
  }
  grouped.position.resize(rows.size());
  std::iota(grouped.position.begin(), grouped.position.end(), std::size_t{0});
  std::ranges::stable_sort(grouped.position, {}, [&](std::size_t i) { return camera[i]; });
  grouped.rows.reserve(rows.size());
  for (const std::size_t i : grouped.position) {
    grouped.rows.push_back(std::move(rows[i]));
  }
  return grouped;
}

LargeText text_in_place(TableText table, const LargeVector<std::size_t>& position) {
  if (position.empty()) {
    return std::move(table.text);
  }
  LargeVector<std::size_t> from(position.size());
  for (std::size_t i = 0; i < position.size(); ++i) {
    from[position[i]] = i;
  }
  LargeText text;
  text.reserve(table.text.size());
  text.append(table.text, 0, table.begins.front());
  table.begins.push_back(table.text.size());
  for (const std::size_t i : from) {
    text.append(table.text, table.begins[i], table.begins[i + 1] - table.begins[i]);
  }
  return text;
}

void for_each_camera(const RayRows& rows, const std::function<void(std::size_t, std::size_t)>& work) {
  constexpr std::size_t longest_run = 1'000'000;
  Progress progress("tracing", static_cast<long>(std::max<std::size_t>(rows.size(), 1)));
  for (std::size_t begin = 0; begin < rows.size();) {
    std::size_t end = begin + 1;
    while (end < rows.size() && end - begin < longest_run && same_camera(rows[begin], rows[end])) {
      ++end;
    }
    if (interrupted()) {
      throw Error("trace", "was stopped before it wrote anything", "run it again");
    }
    work(begin, end);
    begin = end;
    progress.advance_to(static_cast<long>(end));
  }
}

}  // namespace ergodome
