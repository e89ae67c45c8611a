#include "render/disk/disk_grid_builder.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "kernels/core/angles.h"
#include "kernels/disk/disk_grid_kernel.h"
#include "render/disk/disk_derivatives.h"
#include "render/disk/plane_phase.h"
#include "render/lens/hanging_nodes.h"

namespace ergodome {

namespace {

constexpr int disk_columns = 16;
constexpr int disk_rows = 16;
constexpr int deepest_disk_side = 10;
//! Errors are sampled; the worst between the samples is about a quarter larger.
constexpr double disk_safety = 0.8;
//! What a cubic misses by in its middle, over what it misses by at the inner checks.
constexpr float inner_disk_share = 0.0625F / (inner_check * inner_check * (1.0F - inner_check) * (1.0F - inner_check));
//! Cells are no wider than this in the phase of the swing through the plane [rad].
constexpr float widest_phase = 0.6F;

//! A cell on its way: its place in units of the finest cells, and its slot in the tree.
struct OpenDiskCell {
  CellBox box;
  int slot;
  std::array<int, 4> corners;
};

//! What is known of a cell.
struct DiskVerdict {
  unsigned orders = 0;    //!< that may be seen in it
  float error_px = 0.0F;  //!< the worst
  float across_gamma = 0.0F;
  float across_s = 0.0F;
  float area_px = 0.0F;
  bool unseen = false;  //!< an image may be seen of which checks know nothing
  bool steep = false;   //!< in the phase
};

//! Builds a station level by level, so that the rays of a level are traced as one batch.
class DiskGridBuilder {
 public:
  DiskGridBuilder(DiskStation& station, const DiskGridSettings& settings, DiskGridTracer& tracer,
                  const PlanePhase& phase)
      : station_(station), cells_(station.cells), settings_(settings), tracer_(tracer), phase_(phase) {}

  DiskGridStatistics build(const DiskGridCamera& camera) {
    const DiskSpanOnScreen span = disk_span_on_screen(settings_, cells_.r);
    tracer_.begin(camera, converted_aberration<float>(settings_.observer), settings_.pixel, span, settings_.nearness);
    bounds_ = checked_bounds(span, camera.limits);
    std::vector<OpenDiskCell> open = root_cells();
    while (!open.empty()) {
      place_corners(open);
      check(open);
      open = decide(open);
    }
    for (int set = 0; set < station_.sets(); ++set) {
      station_.nodes[set] = tracer_.nodes(set);
    }
    station_.nearness = tracer_.nearness();
    statistics_.nodes = tracer_.node_count();
    statistics_.leaves = static_cast<int>(cells_.leaf_count());
    return statistics_;
  }

 private:
  std::vector<OpenDiskCell> root_cells() {
    cells_.columns = cells_.mirrored ? disk_columns / 2 : disk_columns;
    cells_.rows = disk_rows;
    std::vector<OpenDiskCell> open;
    for (int row = 0; row < cells_.rows; ++row) {
      for (int column = 0; column < cells_.columns; ++column) {
        const CellBox box = {column * finest_a_root, row * finest_a_root, finest_a_root, finest_a_root};
        open.push_back({box, static_cast<int>(cells_.tree.size()), {}});
        cells_.tree.push_back(0);
      }
    }
    return open;
  }

  [[nodiscard]] float gamma_turns(int place) const {
    return static_cast<float>(place) / static_cast<float>(disk_columns * finest_a_root);
  }

  [[nodiscard]] float s_of(int place) const {
    return static_cast<float>(place) / static_cast<float>(disk_rows * finest_a_root);
  }

  //! Finds or makes the nodes of new cells, and traces the new ones.
  void place_corners(std::vector<OpenDiskCell>& open) {
    const int first = tracer_.node_count();
    std::vector<float> gamma;
    std::vector<float> s;
    for (OpenDiskCell& cell : open) {
      for (int corner = 0; corner < 4; ++corner) {
        const NodePlace place = corner_place(cells_, cell.box, corner);
        const auto [found, fresh] = node_by_place_.try_emplace(place.key(), first + static_cast<int>(gamma.size()));
        if (fresh) {
          gamma.push_back(gamma_turns(place.gamma));
          s.push_back(s_of(place.s));
          phases_.push_back(phase_.at(gamma.back(), s.back()));
        }
        cell.corners[static_cast<std::size_t>(corner)] = found->second;
      }
    }
    tracer_.add_nodes(gamma, s);
    statistics_.traced_nodes += static_cast<long>(gamma.size());
  }

  void check(const std::vector<OpenDiskCell>& open) {
    std::vector<GridCell> cells;
    cells.reserve(open.size());
    for (const OpenDiskCell& cell : open) {
      const auto& c = cell.corners;
      cells.push_back({{c[0], c[1], c[2], c[3]},
                       gamma_turns(cell.box.gamma),
                       s_of(cell.box.s),
                       gamma_turns(cell.box.width),
                       s_of(cell.box.height)});
    }
    tracer_.check(cells);
    statistics_.traced_checks += static_cast<long>(checks_a_cell * cells.size());
  }

  //! Whether an order's image of the disk may be seen in a cell: between what is known of 1/r there, and a pixel and a part of that beyond.
  [[nodiscard]] bool may_show(const OpenDiskCell& cell, std::size_t number, int order) const {
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

  //! Whether a check inside a cell lies where the grid is held to be good: those on its sides say little of it.
  [[nodiscard]] bool is_checked(std::size_t number, int order) const {
    const float* const u = tracer_.u(order) + checks_a_cell * number;
    const auto within = [&](float at) { return at > bounds_.low && at < bounds_.high; };
    return within(u[0]) || within(u[checks_a_cell - 1]);
  }

  //! Has a cell split along the side on which 1/r changes more.
  void split_by_corners(const OpenDiskCell& cell, DiskVerdict& verdict) const {
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

  [[nodiscard]] DiskVerdict judge(const OpenDiskCell& cell, std::size_t number) const {
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
    // Where the middles of the sides do not say which of them are too long, the corners do.
    if (verdict.unseen || std::max(verdict.across_gamma, verdict.across_s) < 0.5F * verdict.error_px) {
      split_by_corners(cell, verdict);
    }
    judge_phase(cell, verdict);
    return verdict;
  }

  //! What checks may not see: that light starts on both sides of the plane.
  void judge_phase(const OpenDiskCell& cell, DiskVerdict& verdict) const {
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

  //! Makes leaves of what is good or cannot be made good, and splits the rest.
  std::vector<OpenDiskCell> decide(const std::vector<OpenDiskCell>& open) {
    const auto limit = static_cast<float>(disk_safety * settings_.budget_px);
    const bool full = tracer_.node_count() >= settings_.most_nodes;
    std::vector<OpenDiskCell> next;
    for (std::size_t i = 0; i < open.size(); ++i) {
      const DiskVerdict verdict = judge(open[i], i);
      const CellBox& box = open[i].box;
      const bool may_split_gamma = box.width > finest_a_root >> deepest_disk_side;
      const bool may_split_s = box.height > finest_a_root >> deepest_disk_side;
      const bool bad = verdict.steep || verdict.unseen || (verdict.orders != 0 && verdict.error_px > limit);
      if (!bad || full || verdict.area_px < settings_.least_area_px || !(may_split_gamma || may_split_s)) {
        make_leaf(open[i], verdict, bad);
      } else {
        split(open[i], may_split_gamma && (verdict.across_gamma >= verdict.across_s || !may_split_s) ? 0 : 1, next);
      }
    }
    return next;
  }

  void make_leaf(const OpenDiskCell& cell, const DiskVerdict& verdict, bool flagged) {
    const auto leaf = static_cast<int>(cells_.leaf_count());
    cells_.leaves.insert(cells_.leaves.end(), cell.corners.begin(), cell.corners.end());
    cells_.leaf_error_px.push_back(verdict.orders != 0 ? verdict.error_px : 0.0F);
    // A phase that is too steep may hide images from the checks.
    station_.orders.push_back(static_cast<unsigned char>(flagged ? (1U << layer_orders) - 1U : verdict.orders));
    cells_.tree[static_cast<std::size_t>(cell.slot)] = -1 - (2 * leaf + (flagged ? 1 : 0));
    statistics_.flagged_leaves += flagged ? 1 : 0;
    statistics_.flagged_px += flagged ? static_cast<double>(verdict.area_px) * (cells_.mirrored ? 2.0 : 1.0) : 0.0;
  }

  void split(const OpenDiskCell& cell, int axis, std::vector<OpenDiskCell>& next) {
    const auto children = static_cast<int>(cells_.tree.size());
    cells_.tree[static_cast<std::size_t>(cell.slot)] = 2 * children + axis;
    cells_.tree.insert(cells_.tree.end(), 2, 0);
    CellBox box = cell.box;
    (axis == 0 ? box.width : box.height) /= 2;
    next.push_back({box, children, {}});
    (axis == 0 ? box.gamma : box.s) += axis == 0 ? box.width : box.height;
    next.push_back({box, children + 1, {}});
  }

  DiskStation& station_;
  LensStation& cells_;
  const DiskGridSettings& settings_;
  DiskGridTracer& tracer_;
  const PlanePhase& phase_;
  CheckedBounds bounds_{};
  NodeByPlace node_by_place_;
  std::vector<StartPhase> phases_;
  DiskGridStatistics statistics_;
};

}  // namespace

DiskStation build_disk_station(double spin, double r, double theta, const DiskGridSettings& settings,
                               DiskGridStatistics* statistics, DiskGridTracer* tracer) {
  const DiskChartCamera camera(spin, {r, theta}, settings);
  DiskStation station;
  LensStation& cells = station.cells;
  cells.spin = spin;
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
  const DiskGridStatistics done =
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
