#include "render/passes/disk/disk_grid_builder.h"

#include <algorithm>
#include <cmath>

#include "kernels/core/angles.h"
#include "kernels/disk/disk_grid_kernel.h"
#include "render/lens/grid/growing_grid.h"
#include "render/passes/disk/disk_derivatives.h"
#include "render/passes/disk/plane_phase.h"

namespace ergodome {

namespace {

constexpr int disk_columns = 16;
constexpr int disk_rows = 16;
constexpr int deepest_disk_side = 10;
//! Cells must have errors below this fraction of the budget. Errors are only sampled, and the
//! maximum between the samples is about a quarter larger.
constexpr double disk_safety = 0.8;
//! Ratio of a cubic's interpolation error at the middle of a side to its error at the inner check
//! points.
constexpr float inner_disk_share = 0.0625F / (inner_check * inner_check * (1.0F - inner_check) * (1.0F - inner_check));
//! Maximum range within a cell of the rays' phase of oscillation through the equatorial plane
//! (PlanePhase) [rad].
constexpr float widest_phase = 0.6F;

//! Result of checking a cell.
struct DiskVerdict {
  unsigned orders = 0;    //!< bit set of the orders of crossing that may be visible in the cell
  float error_px = 0.0F;  //!< largest error on the sides, or in the middle as estimated from the inner checks
  float across_gamma = 0.0F;
  float across_s = 0.0F;
  float area_px = 0.0F;
  bool unseen = false;  //!< true if the cell may contain an image that the checks miss
  //! The rays' phases (StartPhase) differ across the cell by more than `widest_phase`.
  bool steep = false;
};

//! Builds a station level by level, so that all rays of a level are traced in one batch.
class DiskGridBuilder {
 public:
  DiskGridBuilder(DiskStation& station, const DiskGridSettings& settings, DiskGridTracer& tracer,
                  const PlanePhase& phase)
      : station_(station),
        cells_(station.cells),
        settings_(settings),
        tracer_(tracer),
        phase_(phase),
        grid_(station.cells, disk_columns, disk_rows) {}

  GridStatistics build(const DiskGridCamera& camera) {
    const DiskSpanOnScreen span = disk_span_on_screen(settings_, cells_.r);
    tracer_.begin(camera, converted_aberration<float>(settings_.observer), settings_.pixel, span, settings_.nearness);
    bounds_ = checked_bounds(span, camera.limits);
    std::vector<OpenCell> open = grid_.root_cells();
    while (!open.empty()) {
      check(open);
      open = decide(open);
    }
    for (int set = 0; set < station_.sets(); ++set) {
      station_.nodes[set] = tracer_.nodes(set);
    }
    station_.nearness = tracer_.nearness();
    grid_.statistics().nodes = tracer_.node_count();
    return grid_.statistics();
  }

 private:
  void check(std::vector<OpenCell>& open) {
    const ChartPositions fresh = grid_.place_corners(open, tracer_.node_count());
    for (std::size_t i = 0; i < fresh.s.size(); ++i) {
      phases_.push_back(phase_.at(fresh.gamma_turns[i], fresh.s[i]));
    }
    tracer_.add_nodes(fresh.gamma_turns, fresh.s);
    tracer_.check(grid_.checked_cells(open));
    grid_.statistics().traced_checks += static_cast<long>(checks_a_cell * open.size());
  }

  //! Returns whether a cell may show the disk's image of an order of crossing: the range of 1/r at
  //! its samples, extended by a pixel and by a fraction of the range, overlaps the disk.
  [[nodiscard]] bool may_show(const OpenCell& cell, std::size_t number, int order) const {
    const float* const u = tracer_.u(order) + checks_a_cell * number;
    const float* const width = tracer_.width(order) + checks_a_cell * number;
    float low = *std::min_element(u, u + checks_a_cell);
    float high = *std::max_element(u, u + checks_a_cell);
    for (const int corner : cell.corners) {
      low = std::min(low, tracer_.u_at(order, corner));
      high = std::max(high, tracer_.u_at(order, corner));
    }
    const float margin = *std::max_element(width, width + checks_a_cell) + 0.15F * (high - low);
    return low - margin < static_cast<float>(1.0 / settings_.inner_r) &&
           high + margin > static_cast<float>(1.0 / settings_.outer_r);
  }

  //! Returns whether a check ray inside a cell meets the plane at a 1/r for which the grid must be
  //! accurate (checked_bounds()). If none does, checks on the sides say little about the inside.
  [[nodiscard]] bool is_checked(std::size_t number, int order) const {
    const float* const u = tracer_.u(order) + checks_a_cell * number;
    const auto within = [&](float at) { return at > bounds_.low && at < bounds_.high; };
    return within(u[0]) || within(u[checks_a_cell - 1]);
  }

  //! Chooses the axis along which a cell is split: that of the side along which 1/r changes more.
  void split_by_corners(const OpenCell& cell, DiskVerdict& verdict) const {
    verdict.across_gamma = 0.0F;
    verdict.across_s = 0.0F;
    for (int order = 0; order < layer_orders; ++order) {
      if ((verdict.orders >> static_cast<unsigned>(order) & 1U) == 0U) {
        continue;
      }
      const auto apart = [&](std::size_t a, std::size_t b) {
        return std::abs(tracer_.u_at(order, cell.corners[a]) - tracer_.u_at(order, cell.corners[b]));
      };
      verdict.across_gamma = std::max({verdict.across_gamma, apart(0, 1), apart(2, 3)});
      verdict.across_s = std::max({verdict.across_s, apart(0, 2), apart(1, 3)});
    }
  }

  [[nodiscard]] DiskVerdict judge(const OpenCell& cell, std::size_t number) const {
    DiskVerdict verdict;
    const float* const e = tracer_.error_px() + checks_a_cell * number;
    const float* const area = tracer_.area_px() + checks_a_cell * number;
    verdict.across_gamma = std::max(e[1], e[2]);
    verdict.across_s = std::max(e[3], e[4]);
    verdict.error_px =
        std::max({inner_disk_share * e[0], inner_disk_share * e[5], verdict.across_gamma, verdict.across_s});
    verdict.area_px = 0.5F * (area[0] + area[5]);
    for (int order = 0; order < layer_orders; ++order) {
      if (may_show(cell, number, order)) {
        verdict.orders |= 1U << static_cast<unsigned>(order);
        verdict.unseen = verdict.unseen || !is_checked(number, order);
      }
    }
    // If the checks at the midpoints of the sides do not show along which axis to split, compares
    // the corners.
    if (verdict.unseen || std::max(verdict.across_gamma, verdict.across_s) < 0.5F * verdict.error_px) {
      split_by_corners(cell, verdict);
    }
    judge_phase(cell, verdict);
    return verdict;
  }

  //! Marks a cell as steep if its rays may reach the disk and their phases differ by more than
  //! `widest_phase`, because its checks may then miss images. Steep cells are split along the axis
  //! along which phases differ more.
  void judge_phase(const OpenCell& cell, DiskVerdict& verdict) const {
    const auto at = [&](std::size_t corner) { return phases_[static_cast<std::size_t>(cell.corners[corner])]; };
    const auto apart = [&](std::size_t a, std::size_t b) { return std::abs(at(a).phase - at(b).phase); };
    const float across_gamma = std::max(apart(0, 1), apart(2, 3));
    const float across_s = std::max(apart(0, 2), apart(1, 3));
    const bool reaches = at(0).reaches || at(1).reaches || at(2).reaches || at(3).reaches;
    verdict.steep = reaches && std::max(across_gamma, across_s) > widest_phase;
    if (verdict.steep) {
      verdict.across_gamma = across_gamma;
      verdict.across_s = across_s;
    }
  }

  //! Makes leaves of cells that are accurate enough or cannot be improved, and splits the others.
  std::vector<OpenCell> decide(const std::vector<OpenCell>& open) {
    const auto limit = static_cast<float>(disk_safety * settings_.budget_px);
    const bool full = tracer_.node_count() >= settings_.max_nodes;
    std::vector<OpenCell> next;
    for (std::size_t i = 0; i < open.size(); ++i) {
      const DiskVerdict verdict = judge(open[i], i);
      const CellBox& box = open[i].box;
      const bool may_split_gamma = box.width > finest_a_root >> deepest_disk_side;
      const bool may_split_s = box.height > finest_a_root >> deepest_disk_side;
      const bool bad = verdict.steep || verdict.unseen || (verdict.orders != 0 && verdict.error_px > limit);
      if (!bad || full || verdict.area_px < settings_.min_area_px || !(may_split_gamma || may_split_s)) {
        make_leaf(open[i], verdict, bad);
      } else {
        grid_.split(open[i], may_split_gamma && (verdict.across_gamma >= verdict.across_s || !may_split_s) ? 0 : 1,
                    next);
      }
    }
    return next;
  }

  void make_leaf(const OpenCell& cell, const DiskVerdict& verdict, bool flagged) {
    grid_.make_leaf(cell, verdict.orders != 0 ? verdict.error_px : 0.0F, flagged, verdict.area_px);
    // The checks of a flagged cell may have missed images, so it is marked as showing all orders.
    station_.orders.push_back(static_cast<unsigned char>(flagged ? (1U << layer_orders) - 1U : verdict.orders));
  }

  DiskStation& station_;
  LensStation& cells_;
  const DiskGridSettings& settings_;
  DiskGridTracer& tracer_;
  const PlanePhase& phase_;
  CheckedBounds bounds_{};
  GrowingGrid grid_;
  std::vector<StartPhase> phases_;
};

}  // namespace

DiskStation build_disk_station(Spacetime spacetime, double r, double theta, const DiskGridSettings& settings,
                               GridStatistics* statistics, DiskGridTracer* tracer) {
  const DiskChartCamera camera(spacetime, {r, theta}, settings);
  DiskStation station;
  LensStation& cells = station.cells;
  cells.spacetime = spacetime;
  cells.r = r;
  cells.theta = theta;
  cells.mirrored = camera.mirrored;
  cells.edge = camera.polar_angle;
  cells.centre = camera.edge.centre;
  cells.first = camera.edge.first;
  cells.second = camera.edge.second;
  station.inner_r = settings.inner_r;
  station.outer_r = settings.outer_r;
  station.pattern = settings.pattern;
  DiskGridTracer own;
  const PlanePhase phase(camera.rain, camera.edge, settings.outer_r);
  const GridStatistics done =
      DiskGridBuilder(station, settings, tracer != nullptr ? *tracer : own, phase).build(camera.camera);
  if (settings.derivatives) {
    add_disk_derivatives(station, settings);
  }
  if (statistics != nullptr) {
    *statistics = done;
  }
  return station;
}

}  // namespace ergodome
