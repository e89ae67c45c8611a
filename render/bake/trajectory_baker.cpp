#include "render/bake/trajectory_baker.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include "content/camera/camera_path.h"
#include "content/show/animated_show.h"
#include "content/show/reading/show_reader.h"
#include "content/trajectory/trajectory_journal.h"
#include "kernels/core/error.h"
#include "render/bake/disk_bake.h"
#include "render/eyes/eye_camera.h"
#include "render/lens/grid/edge_table.h"
#include "render/lens/grid/grid_builder.h"
#include "render/lens/grid/screen_error.h"
#include "render/lens/stations/station_blend.h"

namespace ergodome {

namespace {

//! A stretch whose error exceeds the budget is not divided if its error is at most this multiple of
//! min_error(), which no division can remove.
constexpr double floor_slack = 1.1;
//! Maximum number of parts into which a stretch is divided at once.
constexpr int max_parts = 16;
constexpr int max_halvings = 12;
//! A station whose error at its own position exceeds this fraction of the budget is rebuilt with
//! half the budget, up to `max_finer_grids` times.
constexpr double own_share = 0.8;
constexpr int max_finer_grids = 2;
//! A part of a divided stretch counts as a stall if its error exceeds this fraction of the error of
//! the stretch before the division. After `max_stalls` successive stalls, a part is not divided
//! further.
constexpr double stalled_share = 0.5;
constexpr int max_stalls = 2;
//! Stretches of this many frames or fewer are not divided: with stations so close to each other,
//! building a grid for each frame costs no more than reading stations.
constexpr double min_frames = 4.0;
//! Maximum number of times that a stretch is halved because of errors of the disk layers. Layers
//! are discontinuous where a camera crosses the disk's plane, and halving does not remove that
//! error.
constexpr int max_halvings_for_the_disk = 4;

class Baker {
 public:
  Baker(const Show& show, const BakeSettings& settings, TrajectoryJournal& journal,
        const std::function<bool(double)>& proceed)
      : show_(show), settings_(settings), journal_(journal), proceed_(proceed), disk_(show, settings, journal) {
    const double part_s = show.duration_s / settings.parts;
    begin_s_ = settings.part == 1 ? -INFINITY : part_s * (settings.part - 1);
    end_s_ = settings.part == settings.parts ? INFINITY : part_s * settings.part;
  }

  BakeResult bake() {
    range_ = settings_.derivatives ? common_range() : 0.0;
    const std::vector<double> ends = path_ends_s(show_);
    Station first = touches(ends.front(), ends.front()) ? station(ends.front()) : nullptr;
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
      bake_stretch(ends[i], ends[i + 1], {});
    }
    result_.times_s.push_back(ends.back());
    return std::move(result_);
  }

 private:
  using Station = std::shared_ptr<const LensStation>;

  //! How often a stretch has been divided, because of the lens and because of the disk, and how
  //! many successive divisions left the lens's error above `stalled_share` times the one before.
  struct Depth {
    int lens = 0;
    int disk = 0;
    int stalls = 0;
    double whole_px = INFINITY;  //!< error of the stretch that was divided into this one and others
  };

  [[nodiscard]] bool touches(double from_s, double to_s) const { return to_s >= begin_s_ && from_s <= end_s_; }

  [[nodiscard]] LensView view_at(double time_s) const {
    const EyeCamera eye = eye_camera(show_, camera_pose(show_, time_s), 0.0);
    return {eye.spacetime,
            {eye.r, eye.theta},
            aberration_to_rain(eye.spacetime, eye.r, eye.theta, eye.motion, eye.velocity),
            settings_.pixel,
            settings_.share};
  }

  GridSettings grid_settings(const LensView& view) const {
    GridSettings grid;
    grid.pixel = settings_.pixel;
    grid.budget_px = baked_grid_share * settings_.budget_px;
    grid.observer = view.observer;
    grid.derivatives = settings_.derivatives;
    grid.range = range_;
    return grid;
  }

  //! Returns the LensChart::range of all stations: the maximum of chart_range() at 65 show times.
  //! All stations have the same range, because a station's derivatives along r and θ are computed
  //! for a fixed range.
  [[nodiscard]] double common_range() const {
    constexpr int samples = 64;
    double range = 0.0;
    for (int i = 0; i <= samples; ++i) {
      const LensView view = view_at(show_.duration_s * i / samples);
      range = std::max(range, chart_range(view.spacetime, view.position.r, view.position.theta, grid_settings(view)));
    }
    return range;
  }

  //! Builds a station. Where a caustic crosses the sky, a grid whose cells all keep the budget at
  //! their check points may still exceed it in more than a thousandth of the view, and blending
  //! cannot correct that; such grids are built with a smaller budget.
  [[nodiscard]] LensStation built_station(double time_s) const {
    const LensView view = view_at(time_s);
    GridSettings grid = grid_settings(view);
    LensStation built = build_lens_station(view.spacetime, view.position.r, view.position.theta, grid);
    for (int i = 0; i < max_finer_grids && own_error(built, time_s) > own_share * settings_.budget_px; ++i) {
      grid.budget_px *= 0.5;
      built = build_lens_station(view.spacetime, view.position.r, view.position.theta, grid);
    }
    return built;
  }

  Station station(double time_s) {
    if (Station kept = recent_[time_s].lock()) {
      return kept;
    }
    if (!journal_.has_station(time_s)) {
      journal_.add(time_s, built_station(time_s));
      ++result_.built;
    }
    if (disk_.wanted()) {
      disk_.add_if_missing(time_s);
    }
    auto read = std::make_shared<const LensStation>(journal_.read(time_s));
    recent_[time_s] = read;
    return read;
  }

  void note_gap(const Gap& gap) {
    const auto error_px = static_cast<double>(gap.error_px);
    result_.times_s.push_back(gap.begin_s);
    if (error_px > result_.worst_px) {
      result_.worst_px = error_px;
      result_.worst_time_s = 0.5 * (gap.begin_s + gap.end_s);
    }
    result_.unmet += error_px > settings_.budget_px ? 1 : 0;
    result_.live_disk_s += meets_budget(gap.disk_error_px) ? 0.0 : gap.end_s - gap.begin_s;
    std::erase_if(recent_, [](const auto& kept) { return kept.second.expired(); });
    if (!proceed_(gap.end_s)) {
      throw Error("bake", fmt::format("stopped at {:.3f} s of the show", gap.end_s), "run it again to continue");
    }
  }

  void bake_stretch(double begin_s, double end_s, Depth depth) {
    if (!touches(begin_s, end_s)) {
      return;
    }
    if (const Gap* known = journal_.find_gap(begin_s, end_s)) {
      return note_gap(*known);
    }
    const Station first = station(begin_s);
    const Station last = station(end_s);
    const double error_px = gap_error(*first, *last, begin_s, end_s);
    const double floor_px = error_px > settings_.budget_px ? min_error(*first, *last, begin_s, end_s) : 0.0;
    const int stalls = error_px > stalled_share * depth.whole_px ? depth.stalls + 1 : 0;
    const bool long_enough = (end_s - begin_s) * show_.frame_rate_hz > min_frames;
    const bool may_help = long_enough && depth.lens < max_halvings && stalls < max_stalls;
    if (error_px > std::max(settings_.budget_px, floor_slack * floor_px) && may_help) {
      const int parts = stalls > 0 ? 2 : wished_parts(error_px);
      return divide(begin_s, end_s, parts, {depth.lens + 1, depth.disk, stalls, error_px});
    }
    const double disk_px = disk_.wanted() ? disk_.gap_error(begin_s, end_s) : 0.0;
    if (disk_px > settings_.budget_px && long_enough && depth.disk < max_halvings_for_the_disk) {
      return divide(begin_s, end_s, 2, {depth.lens, depth.disk + 1, stalls, depth.whole_px});
    }
    const Gap gap = {begin_s, end_s, static_cast<float>(error_px), static_cast<float>(disk_px)};
    journal_.add(gap);
    note_gap(gap);
  }

  //! Returns the number of parts into which a stretch should be divided, from 2 to `max_parts`.
  //! Blending errors grow with the square of the distance between stations; if stations have
  //! derivatives along r and θ, with its fourth power.
  [[nodiscard]] int wished_parts(double error_px) const {
    const double wished = std::ceil(std::pow(error_px / settings_.budget_px, settings_.derivatives ? 0.25 : 0.5));
    return static_cast<int>(std::clamp(wished, 2.0, 1.0 * max_parts));
  }

  void divide(double begin_s, double end_s, int parts, Depth depth) {
    double from_s = begin_s;
    for (int i = 1; i <= parts; ++i) {
      const double to_s = i < parts ? begin_s + (end_s - begin_s) * i / parts : end_s;
      bake_stretch(from_s, to_s, depth);
      from_s = to_s;
    }
  }

  [[nodiscard]] bool meets_budget(float error_px) const { return static_cast<double>(error_px) <= settings_.budget_px; }

  //! Returns whether the head's observer has the same velocity at two times.
  [[nodiscard]] bool moves_alike(double first_s, double second_s) const {
    const EyeCamera first = eye_camera(show_, camera_pose(show_, first_s), 0.0);
    const EyeCamera second = eye_camera(show_, camera_pose(show_, second_s), 0.0);
    const Vector3<double> change = second.velocity - first.velocity;
    return first.motion == second.motion && dot(change, change) == 0.0;
  }

  //! Returns the largest error [px] of blending two stations, at a quarter, half and three quarters
  //! of the time between them, and of the shadow's edge at both. If the camera's position does not
  //! change, also at the end; if its velocity does not change either, returns only the error of the
  //! edge in the first station.
  [[nodiscard]] double gap_error(const LensStation& first, const LensStation& last, double begin_s,
                                 double end_s) const {
    const double length_s = end_s - begin_s;
    const double early_s = begin_s + 0.25 * length_s;
    const double middle_s = begin_s + 0.5 * length_s;
    const double late_s = begin_s + 0.75 * length_s;
    double error_px = 0.0;
    constexpr double rounding = 1e-12;
    if (std::abs(last.r - first.r) <= rounding * first.r && std::abs(last.theta - first.theta) <= rounding) {
      if (moves_alike(begin_s, early_s) && moves_alike(begin_s, middle_s) && moves_alike(begin_s, end_s)) {
        return edge_error(first, begin_s);
      }
      // The first station is used for the whole stretch; its error is largest at the end, where the
      // velocity differs most from that at the station.
      error_px = blending_error(first, last, end_s);
    }
    // Where the camera accelerates towards the hole, the error of a gap peaks in its last quarter.
    return std::max({error_px, blending_error(first, last, middle_s), blending_error(first, last, early_s),
                     blending_error(first, last, late_s), edge_error(first, begin_s), edge_error(last, end_s)});
  }

  //! Returns the error of blending at one time [px].
  [[nodiscard]] double blending_error(const LensStation& first, const LensStation& last, double time_s) const {
    const LensView view = view_at(time_s);
    const StationBlend blend(Backend::cpu, on_host(first), on_host(last), view.position);
    return error_of(blend, view, first.leaf_count() > last.leaf_count() ? first : last);
  }

  //! Returns the error of a station at its own position [px].
  [[nodiscard]] double own_error(const LensStation& station, double time_s) const {
    const StationBlend alone(on_host(station));
    return error_of(alone, view_at(time_s), station);
  }

  //! Returns the part of a stretch's error that no division can remove [px]: blends are no more
  //! accurate than the stations' grids, and if the shadow's edge is wrong at both ends, it is also
  //! wrong in between.
  [[nodiscard]] double min_error(const LensStation& first, const LensStation& last, double begin_s,
                                 double end_s) const {
    return std::max({own_error(first, begin_s), own_error(last, end_s),
                     std::min(edge_error(first, begin_s), edge_error(last, end_s))});
  }

  //! Returns the error of the shadow's edge in a station [px], which a finer grid does not reduce.
  [[nodiscard]] double edge_error(const LensStation& station, double time_s) const {
    const EyeCamera eye = eye_camera(show_, camera_pose(show_, time_s), 0.0);
    const CameraStation observer = make_camera_station(eye.spacetime, eye.r, eye.theta, 0.0, eye.motion, eye.velocity);
    return edge_miss(grid_view(station).chart.edge, observer, view_at(time_s).observer) / settings_.pixel;
  }

  static std::shared_ptr<const StationBuffers> on_host(const LensStation& station) {
    return std::make_shared<StationBuffers>(Backend::cpu, station);
  }

  static double error_of(const StationBlend& lens, const LensView& view, const LensStation& sampled) {
    return gap_measure(measure_screen_error(lens.view(), view, screen_samples(sampled, lens.view().chart, view)));
  }

  const Show& show_;
  const BakeSettings& settings_;
  TrajectoryJournal& journal_;
  const std::function<bool(double)>& proceed_;
  double begin_s_;
  double end_s_;
  double range_ = 0.0;
  DiskBake disk_;
  std::map<double, std::weak_ptr<const LensStation>> recent_;
  BakeResult result_;
};

}  // namespace

TrajectoryProvenance provenance_of(const Show& show, const BakeSettings& settings) {
  if (find_animation(show, "hole.spin") != nullptr) {
    throw Error(show.name, "the spin changes with time (hole.spin), but lenses are baked for one spin",
                "play or render it with --lens live, or keep the spin constant");
  }
  // Changes of captions and tone need no new lenses.
  Show baked = show;
  baked.timeline = {};
  return {ERGODOME_VERSION,   to_toml(baked),       spacetime_of(show),           settings.pixel,
          settings.budget_px, settings.derivatives, disk_to_bake(show) != nullptr};
}

BakeResult bake_trajectory(const Show& show, const BakeSettings& settings, TrajectoryJournal& journal,
                           const std::function<bool(double)>& proceed) {
  return Baker(show, settings, journal, proceed).bake();
}

}  // namespace ergodome
