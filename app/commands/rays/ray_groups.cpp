#include "app/commands/rays/ray_groups.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "app/cli/interrupt.h"
#include "app/cli/progress.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

//! Returns the values that distinguish cameras.
auto values_of(const RayCamera& camera) {
  return std::tuple(camera.spacetime.spin, camera.r, camera.theta, camera.motion, camera.velocity.x, camera.velocity.y,
                    camera.velocity.z);
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

bool group_by_camera(RayTable& table) {
  std::map<decltype(values_of(table.cameras[0])), std::uint32_t> first_with;
  std::vector<std::uint32_t> same;
  same.reserve(table.cameras.size());
  for (const RayCamera& camera : table.cameras) {
    same.push_back(first_with.try_emplace(values_of(camera), static_cast<std::uint32_t>(same.size())).first->second);
  }
  if (first_with.size() == same.size()) {
    return true;
  }
  for (RayRow& row : table.rows) {
    row.camera = same[row.camera];
  }
  std::ranges::stable_sort(table.rows, {}, &RayRow::camera);
  return std::ranges::is_sorted(table.rows, {}, &RayRow::number);
}

LargeText text_in_order(TableText table, const RayRows& rows) {
  if (table.begins.empty()) {
    return std::move(table.text);  // finished lines were passed on in order
  }
  LargeVector<std::size_t> from(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    from[rows[i].number] = i;
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

CameraStation station_of(const RayCamera& camera) {
  return make_camera_station(camera.spacetime, camera.r, camera.theta, 0.0, camera.motion, camera.velocity);
}

void for_each_camera(const RayRows& rows, const std::function<void(std::size_t, std::size_t)>& work) {
  constexpr std::size_t longest_run = 1'000'000;
  Progress progress("tracing", static_cast<long>(std::max<std::size_t>(rows.size(), 1)));
  for (std::size_t begin = 0; begin < rows.size();) {
    std::size_t end = begin + 1;
    while (end < rows.size() && end - begin < longest_run && rows[begin].camera == rows[end].camera) {
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
