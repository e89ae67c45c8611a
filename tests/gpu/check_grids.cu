#include <algorithm>

#include "kernels/lens/grid_build_kernel.h"
#include "kernels/lens/look_up_kernel.h"
#include "tests/gpu/dome.cuh"

namespace ergodome::gpu_check {

namespace {

// A power of two: the positions of nodes are then exact, and lie on the same side of each point of
// the edge on CPU and GPU. The edge is a cubic between its points, and its slope jumps at them.
constexpr int columns = 128;
constexpr int rows = 64;

//! A lens grid of equal cells without hierarchy, which is sufficient to compare all kernels that
//! trace or read grids.
struct UniformGrid {
  Twin<float> edge{1024};
  Twin<float> gamma_turns{columns * (rows + 1)};
  Twin<float> s{columns * (rows + 1)};
  Twin<float> nodes{std::size_t{floats_a_node} * columns * (rows + 1)};
  Twin<int> tree{columns * rows};
  Twin<int> leaves{std::size_t{4} * columns * rows};
  Twin<GridCell> cells{columns * rows};
  CameraStation rain = make_camera_station(Spacetime{0.999}, 5.0, 1.5707963, 0.0, ObserverMotion::rain);
  LensChart chart{};

  UniformGrid() {
    const ShadowChart axes = make_shadow_chart(rain);
    solve_edge(rain, axes, edge);
    chart = {edge_curve(axes, edge), 9.0F};
    for (int row = 0; row <= rows; ++row) {
      for (int column = 0; column < columns; ++column) {
        const auto node = static_cast<std::size_t>(row * columns + column);
        gamma_turns.host[node] = static_cast<float>(column) / columns;
        s.host[node] = static_cast<float>(row) / rows;
      }
    }
    for (int cell = 0; cell < columns * rows; ++cell) {
      const int row = cell / columns;
      const int column = cell % columns;
      const int next = (column + 1) % columns;
      // Marks every seventh cell as inaccurate, so that its pixels are traced.
      tree.host[static_cast<std::size_t>(cell)] = -1 - (2 * cell + (cell % 7 == 0 ? 1 : 0));
      const int corners[4] = {row * columns + column, row * columns + next, (row + 1) * columns + column,
                              (row + 1) * columns + next};
      std::copy_n(corners, 4, leaves.host.begin() + 4 * cell);
      GridCell& made = cells.host[static_cast<std::size_t>(cell)];
      std::copy_n(corners, 4, made.corners);
      made.gamma_turns = static_cast<float>(column) / columns;
      made.s = static_cast<float>(row) / rows;
      made.width_turns = 1.0F / columns;
      made.height = 1.0F / rows;
    }
    for (auto* each : {&gamma_turns, &s}) {
      each->upload();
    }
    tree.upload();
    leaves.upload();
    cells.upload();
  }

  [[nodiscard]] LensChart device_chart() const {
    LensChart there = chart;
    there.edge.polar_angle = edge.device();
    return there;
  }

  template <class S>
  [[nodiscard]] GridCamera<S> camera(const LensChart& where) const {
    return {converted_station<S>(rain), where, {1e-6, 400, true}};
  }
};

bool check_nodes(UniformGrid& grid) {
  const int count = columns * (rows + 1);
  const NodeBatch<float> on_host = {grid.camera<float>(grid.chart), count, grid.gamma_turns.host.data(),
                                    grid.s.host.data(), grid.nodes.host.data()};
  const NodeBatch<float> on_device = {grid.camera<float>(grid.device_chart()), count, grid.gamma_turns.device(),
                                      grid.s.device(), grid.nodes.device()};
  const double device_ms = run_on_device_ms("trace_nodes", TraceNodes<float>{on_device}, count);
  const double host_ms = run_on_host_ms(TraceNodes<float>{on_host}, count);
  // Derivatives along s are large near the edge of the shadow and depend on the rounding of
  // positions to float. CPU and GPU have different errors of the same size, so both are compared
  // with double.
  Twin<float> exact(grid.nodes.host.size());
  const NodeBatch<double> in_double = {{converted_station<double>(grid.rain), grid.chart, {1e-12, 400, true}},
                                       count,
                                       grid.gamma_turns.host.data(),
                                       grid.s.host.data(),
                                       exact.host.data()};
  run_on_host_ms(TraceNodes<double>{in_double}, count);
  const double host_error = compare(grid.nodes.host, exact.host, 0.95, 0.0).quantile;
  const bool good = report("trace_nodes", count, device_ms, host_ms,
                           compare(grid.nodes.download(), exact.host, 0.95, 2.0 * host_error));
  constexpr double maximum = 5e-3;
  std::printf("%-34s %56.2e %s\n", "  the processor's own", host_error, host_error < maximum ? "good" : "DIFFERS");
  grid.nodes.upload();
  return good && host_error < maximum;
}

bool check_checks(UniformGrid& grid) {
  const int count = checks_a_cell * columns * rows;
  Twin<float> error_px(static_cast<std::size_t>(count));
  Twin<float> area_px(static_cast<std::size_t>(count));
  Twin<float> gamma_parts(static_cast<std::size_t>(count));
  Twin<float> s_parts(static_cast<std::size_t>(count));
  const AberrationOf<float> observer =
      converted_aberration<float>(aberration_to_rain(Spacetime{0.999}, 5.0, 1.5707963, ObserverMotion::zamo, {}));
  const float pixel = 7.67e-4F;
  const CheckBatch<float> on_host = {grid.camera<float>(grid.chart),
                                     observer,
                                     pixel,
                                     count,
                                     grid.cells.host.data(),
                                     grid.nodes.host.data(),
                                     error_px.host.data(),
                                     area_px.host.data(),
                                     gamma_parts.host.data(),
                                     s_parts.host.data()};
  const CheckBatch<float> on_device = {grid.camera<float>(grid.device_chart()),
                                       observer,
                                       pixel,
                                       count,
                                       grid.cells.device(),
                                       grid.nodes.device(),
                                       error_px.device(),
                                       area_px.device(),
                                       gamma_parts.device(),
                                       s_parts.device()};
  const double device_ms = run_on_device_ms("check_cells", CheckCells<float>{on_device}, count);
  const double host_ms = run_on_host_ms(CheckCells<float>{on_host}, count);
  return report("check_cells", count, device_ms, host_ms, compare(area_px.download(), area_px.host, 0.999, 1e-4)) &&
         compare(error_px.download(), error_px.host, 0.9, 0.05).good &&
         compare(gamma_parts.download(), gamma_parts.host, 0.9, 0.05).good &&
         compare(s_parts.download(), s_parts.host, 0.9, 0.05).good;
}

bool check_look_up(UniformGrid& grid, int size) {
  const auto pixels = static_cast<std::size_t>(size) * static_cast<std::size_t>(size);
  Twin<float> lens(channel_count * pixels);
  const CameraStation zamo = make_camera_station(Spacetime{0.999}, 5.0, 1.5707963, 0.0, ObserverMotion::zamo);
  LookUpBatch on_host{};
  on_host.pixels = dome_batch(size, grid.edge, make_shadow_chart(zamo));
  on_host.aberration =
      converted_aberration<float>(aberration_to_rain(Spacetime{0.999}, 5.0, 1.5707963, ObserverMotion::zamo, {}));
  const LensGrid read = {
      grid.chart, 0, columns, rows, grid.tree.host.data(), grid.leaves.host.data(), grid.nodes.host.data()};
  on_host.lens.chart = grid.chart;
  on_host.lens.grids[0] = read;
  LookUpBatch on_device = on_host;
  on_device.lens.chart = grid.device_chart();
  on_device.lens.grids[0] = {grid.device_chart(), 0, columns, rows, grid.tree.device(), grid.leaves.device(),
                             grid.nodes.device()};
  on_host.pixels.out = lens_at(lens.host.data(), pixels);
  on_device.pixels.out = lens_at(lens.device(), pixels);
  const int count = static_cast<int>(pixels);
  const double device_ms = run_on_pixels_ms("look_up_pixels", LookUpPixels<float, true>{on_device}, size);
  const double host_ms = run_on_host_ms(LookUpPixels<float, true>{on_host}, count);
  return report("look_up_pixels " + std::to_string(size) + "^2 dome", count, device_ms, host_ms,
                compare(lens.download(), lens.host, 0.98, 1e-3));
}

}  // namespace

bool check_grids() {
  UniformGrid grid;
  bool good = check_nodes(grid);
  good = check_checks(grid) && good;
  good = check_look_up(grid, 1024) && good;
  return check_look_up(grid, 4096) && good;
}

}  // namespace ergodome::gpu_check
