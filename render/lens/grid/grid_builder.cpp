#include "render/lens/grid/grid_builder.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "kernels/core/angles.h"
#include "kernels/spacetime/shadow/critical_curve.h"
#include "render/lens/grid/edge_table.h"
#include "render/lens/grid/growing_grid.h"
#include "render/lens/grid/hanging_nodes.h"
#include "render/lens/stations/station_derivatives.h"

namespace ergodome {

namespace {

constexpr int root_columns = 16;
constexpr int root_rows = 8;
constexpr int deepest_a_side = 10;
//! Cells must have errors below this fraction of the budget. Errors are only sampled, and the
//! maximum between the samples is about a quarter larger.
constexpr double safety = 0.8;
constexpr int grid_step_limit = 400;

//! Returns the largest error in a cell from the errors at its check points. The errors at the inner
//! check points, the first and the last, are multiplied by inner_share.
float worst_of(const float* checks) {
  return std::max({inner_share * checks[0], checks[1], checks[2], checks[3], checks[4], inner_share * checks[5]});
}

//! Returns the angle from the shadow's edge, in the rain frame, below which the lens may show the
//! same sky for all directions, because that displaces them by at most half the budget; at least
//! 3e-7 rad.
double cut_off(const GridSettings& settings, const EdgeCurve& edge) {
  double largest_scale = 0.0;
  for (int i = 0; i < edge.count; i += edge.count / 32) {
    const double gamma = 2.0 * pi * i / edge.count;
    const double alpha = static_cast<double>(edge.polar_angle[i]);
    const auto along = [&](const Vector3<float>& axis, double part) {
      return part *
             Vector3<double>{static_cast<double>(axis.x), static_cast<double>(axis.y), static_cast<double>(axis.z)};
    };
    const Vector3<double> n = along(edge.centre, std::cos(alpha)) +
                              along(edge.first, std::sin(alpha) * std::cos(gamma)) +
                              along(edge.second, std::sin(alpha) * std::sin(gamma));
    largest_scale = std::max(largest_scale, observed_scale(settings.observer, n));
  }
  // Float resolves directions to about 1e-7 rad.
  return std::max(0.5 * settings.budget_px * settings.pixel / largest_scale, 3e-7);
}

double range_for(const GridSettings& settings, const EdgeCurve& edge) {
  return std::log((pi - static_cast<double>(edge.smallest)) / cut_off(settings, edge));
}

//! Builds a station level by level, so that all rays of a level are traced as one batch. S is the
//! precision of the rays. `rays_at` returns the camera for rays at a position: that of the station,
//! or one beside it.
template <class S, class Camera>
class GridBuilder {
 public:
  using RaysAt = std::function<Camera(const LensPosition& position)>;

  GridBuilder(LensStation& station, const GridSettings& settings, GridTracer<S, Camera>& tracer, RaysAt rays_at)
      : station_(station),
        settings_(settings),
        tracer_(tracer),
        rays_at_(std::move(rays_at)),
        grid_(station, root_columns, root_rows) {}

  GridStatistics build() {
    tracer_.begin(make_camera({station_.r, station_.theta}, grid_view(station_).chart),
                  converted_aberration<S>(settings_.observer), settings_.pixel);
    std::vector<OpenCell> open = grid_.root_cells();
    while (!open.empty()) {
      check(open);
      open = decide(open);
    }
    station_.nodes = tracer_.nodes();
    if (settings_.inverted) {
      station_.traced_nodes = station_.nodes;
    }
    if (settings_.derivatives) {
      trace_derivatives();
    }
    mend_hanging_nodes(station_, grid_.nodes(), grid_.leaf_boxes());
    grid_.statistics().nodes = static_cast<int>(station_.node_count());
    return grid_.statistics();
  }

 private:
  [[nodiscard]] GridCamera<S, Camera> make_camera(const LensPosition& position, const LensChart& chart) const {
    const double tolerance = 0.005 * settings_.budget_px * settings_.pixel;
    return {
        rays_at_(position), chart, {std::clamp(tolerance, sizeof(S) == 4 ? 3e-7 : 1e-12, 1e-5), grid_step_limit, true}};
  }

  void trace_derivatives() {
    const ChartPositions positions = grid_.node_positions(station_.node_count());
    const NodeTracer trace = [&](const LensPosition& position, const LensChart& chart) {
      grid_.statistics().traced_nodes += static_cast<long>(positions.s.size());
      return tracer_.nodes_of(make_camera(position, chart), positions.gamma_turns, positions.s);
    };
    if (settings_.reach) {
      add_cell_motion(station_, *settings_.reach, trace);
    } else {
      add_derivatives(station_, trace);
    }
  }

  void check(std::vector<OpenCell>& open) {
    const ChartPositions fresh = grid_.place_corners(open, tracer_.node_count());
    tracer_.add_nodes(fresh.gamma_turns, fresh.s);
    tracer_.check(grid_.checked_cells(open), checks_);
    grid_.statistics().traced_checks += static_cast<long>(checks_.error_px.size());
  }

  //! Turns cells into leaves if they are accurate enough, smaller than min_area_px or of the
  //! maximum depth, or if the grid has max_nodes nodes. Splits the others and returns their halves.
  std::vector<OpenCell> decide(const std::vector<OpenCell>& open) {
    const auto limit = static_cast<float>(safety * settings_.budget_px);
    const bool full = tracer_.node_count() >= settings_.max_nodes;
    std::vector<OpenCell> next;
    for (std::size_t i = 0; i < open.size(); ++i) {
      const float* const e = checks_.error_px.data() + checks_a_cell * i;
      const float* const area_at = checks_.area_px.data() + checks_a_cell * i;
      const float across_gamma = std::max(e[1], e[2]);
      const float across_s = std::max(e[3], e[4]);
      const float worst = worst_of(e);
      const float area = 0.5F * (area_at[0] + area_at[5]);
      const CellBox& box = open[i].box;
      const bool may_split_gamma = box.width > finest_a_root >> deepest_a_side;
      const bool may_split_s = box.height > finest_a_root >> deepest_a_side;
      if (worst <= limit || full || area < settings_.min_area_px || !(may_split_gamma || may_split_s)) {
        keep_displacements(i);
        grid_.make_leaf(open[i], worst, worst > limit, area);
      } else {
        grid_.split(open[i], may_split_gamma && (across_gamma >= across_s || !may_split_s) ? 0 : 1, next);
      }
    }
    return next;
  }

  void keep_displacements(std::size_t cell) {
    if (settings_.inverted) {
      for (const std::vector<float>* parts : {&checks_.gamma_parts, &checks_.s_parts}) {
        const auto first = parts->begin() + static_cast<std::ptrdiff_t>(checks_a_cell * cell);
        station_.leaf_displacements.insert(station_.leaf_displacements.end(), first, first + checks_a_cell);
      }
    }
  }

  LensStation& station_;
  const GridSettings& settings_;
  GridTracer<S, Camera>& tracer_;
  RaysAt rays_at_;
  GrowingGrid grid_;
  CellChecks checks_;
};

}  // namespace

double chart_range(Spacetime spacetime, double r, double theta, const GridSettings& settings) {
  const EdgeTable edge(Backend::cpu, make_camera_station(spacetime, r, theta, 0.0, ObserverMotion::rain), edge_points);
  return range_for(settings, edge.view());
}

LensStation build_lens_station(Spacetime spacetime, double r, double theta, const GridSettings& settings,
                               GridStatistics* statistics, GridTracer<float>* tracer) {
  LensStation station;
  station.spacetime = spacetime;
  station.r = r;
  station.theta = theta;
  station.mirrored = std::abs(theta - 0.5 * pi) < 1e-9 && !settings.derivatives;
  const CameraStation rain = make_camera_station(spacetime, r, theta, 0.0, ObserverMotion::rain);
  const ShadowChart chart = make_shadow_chart(rain);
  station.edge = solve_edge(rain, chart, edge_points, station.mirrored);
  const EdgeCurve edge = edge_view(chart, station.edge);
  station.centre = edge.centre;
  station.first = edge.first;
  station.second = edge.second;
  station.range = static_cast<float>(settings.range > 0.0 ? settings.range : range_for(settings, edge));
  const auto build = [&]<class S>(GridTracer<S>& with) {
    return GridBuilder<S, CameraStationOf<S>>(station, settings, with,
                                              [&](const LensPosition& position) {
                                                return converted_station<S>(make_camera_station(
                                                    spacetime, position.r, position.theta, 0.0, ObserverMotion::rain));
                                              })
        .build();
  };
  GridTracer<float> own;
  GridTracer<double> fine;
  const GridStatistics done = settings.fine ? build(fine) : build(tracer != nullptr ? *tracer : own);
  if (statistics != nullptr) {
    *statistics = done;
  }
  return station;
}

LensStation build_omni_station(const OmniCameraOf<float>& cameras, const ShadowChart& chart, std::vector<float> edge,
                               const GridSettings& settings, GridStatistics* statistics) {
  GridSettings own = settings;
  own.observer = no_aberration();
  own.derivatives = false;
  LensStation station;
  station.spacetime = Spacetime{static_cast<double>(cameras.spin)};
  station.edge = std::move(edge);
  const EdgeCurve curve = edge_view(chart, station.edge);
  station.centre = curve.centre;
  station.first = curve.first;
  station.second = curve.second;
  station.range = static_cast<float>(own.range > 0.0 ? own.range : range_for(own, curve));
  GridTracer<float, OmniCameraOf<float>> tracer;
  const GridStatistics done = GridBuilder<float, OmniCameraOf<float>>(station, own, tracer, [&](const LensPosition&) {
                                return cameras;
                              }).build();
  if (statistics != nullptr) {
    *statistics = done;
  }
  return station;
}

}  // namespace ergodome
