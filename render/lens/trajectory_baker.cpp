#include "render/lens/trajectory_baker.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include "content/animated_show.h"
#include "content/camera_path.h"
#include "content/show_reader.h"
#include "content/trajectory/trajectory_journal.h"
#include "kernels/core/error.h"
#include "render/lens/eye_camera.h"
#include "render/lens/grid_builder.h"
#include "render/lens/screen_error.h"
#include "render/lens/station_blend.h"

namespace ergodome {

namespace {

//! Of the budget, for the grid of a station; what blending adds has to fit into the rest.
constexpr double grid_share = 0.5;
//! What is worse than the budget in a hundredth of the sky is worse than so many budgets in a thousandth at most.
constexpr double far_off = 5.0;
//! A gap is good enough when it misses by so much more than its stations do by themselves.
constexpr double floor_slack = 1.1;
//! A stretch is divided into so many parts at once at most.
constexpr int most_parts = 16;
constexpr int most_halvings = 12;

class Baker {
 public:
  Baker(const Show& show, const BakeSettings& settings, TrajectoryJournal& journal,
        const std::function<bool(double)>& proceed)
      : show_(show), settings_(settings), journal_(journal), proceed_(proceed) {
    const double part_s = show.duration_s / settings.parts;
    begin_s_ = settings.part == 1 ? -INFINITY : part_s * (settings.part - 1);
    end_s_ = settings.part == settings.parts ? INFINITY : part_s * settings.part;
  }

  BakeResult bake() {
    range_ = settings_.derivatives ? common_range() : 0.0;
    const std::vector<double> ends = stretch_ends();
    Station first = touches(ends.front(), ends.front()) ? station(ends.front()) : nullptr;
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
      bake_stretch(ends[i], ends[i + 1], 0);
    }
    result_.times_s.push_back(ends.back());
    return std::move(result_);
  }

 private:
  using Station = std::shared_ptr<const LensStation>;

  //! Between these times the camera runs monotonously.
  [[nodiscard]] std::vector<double> stretch_ends() const {
    std::vector<double> ends = {0.0, show_.duration_s};
    for (const CameraKey& key : show_.camera.keys) {
      ends.push_back(std::clamp(key.time_s, 0.0, show_.duration_s));
      ends.push_back(std::clamp(key.time_s + key.hold_s, 0.0, show_.duration_s));
    }
    std::sort(ends.begin(), ends.end());
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    return ends;
  }

  [[nodiscard]] bool touches(double from_s, double to_s) const { return to_s >= begin_s_ && from_s <= end_s_; }

  [[nodiscard]] LensView view_at(double time_s) const {
    const EyeCamera eye = eye_camera(show_, camera_pose(show_, time_s), 0.0);
    return {eye.spin,
            {eye.r, eye.theta},
            aberration_to_rain(eye.spin, eye.r, eye.theta, eye.motion, eye.velocity),
            settings_.pixel};
  }

  GridSettings grid_settings(const LensView& view) const {
    GridSettings grid;
    grid.pixel = settings_.pixel;
    grid.budget_px = grid_share * settings_.budget_px;
    grid.observer = view.observer;
    grid.derivatives = settings_.derivatives;
    grid.range = range_;
    return grid;
  }

  //! One range for all charts of the path: derivatives are taken at a fixed one.
  [[nodiscard]] double common_range() const {
    constexpr int samples = 64;
    double range = 0.0;
    for (int i = 0; i <= samples; ++i) {
      const LensView view = view_at(show_.duration_s * i / samples);
      range = std::max(range, chart_range(view.spin, view.place.r, view.place.theta, grid_settings(view)));
    }
    return range;
  }

  Station station(double time_s) {
    if (Station kept = recent_[time_s].lock()) {
      return kept;
    }
    if (!journal_.has_station(time_s)) {
      const LensView view = view_at(time_s);
      journal_.add(time_s, build_lens_station(view.spin, view.place.r, view.place.theta, grid_settings(view)));
      ++result_.built;
    }
    auto read = std::make_shared<const LensStation>(journal_.read(time_s));
    recent_[time_s] = read;
    return read;
  }

  void note_gap(double begin_s, double end_s, double error_px) {
    result_.times_s.push_back(begin_s);
    result_.worst_px = std::max(result_.worst_px, error_px);
    result_.unmet += error_px > settings_.budget_px ? 1 : 0;
    std::erase_if(recent_, [](const auto& kept) { return kept.second.expired(); });
    if (!proceed_(end_s)) {
      throw Error("bake", fmt::format("stopped at {:.3f} s of the show", end_s), "run it again to go on");
    }
  }

  void bake_stretch(double begin_s, double end_s, int depth) {
    if (!touches(begin_s, end_s)) {
      return;
    }
    if (const float* known = journal_.find_gap(begin_s, end_s)) {
      return note_gap(begin_s, end_s, static_cast<double>(*known));
    }
    const Station first = station(begin_s);
    const Station last = station(end_s);
    const double error_px = std::max(blending_error(*first, *last, begin_s + 0.5 * (end_s - begin_s)),
                                     blending_error(*first, *last, begin_s + 0.25 * (end_s - begin_s)));
    // Blends cannot be better than the grids that they are made of.
    const double floor_px =
        error_px > settings_.budget_px ? std::max(own_error(*first, begin_s), own_error(*last, end_s)) : 0.0;
    if (error_px > std::max(settings_.budget_px, floor_slack * floor_px) && depth < most_halvings) {
      // Errors go with the square of the distance, with derivatives with its fourth power.
      const double wished = std::ceil(std::pow(error_px / settings_.budget_px, settings_.derivatives ? 0.25 : 0.5));
      const int parts = static_cast<int>(std::clamp(wished, 2.0, 1.0 * most_parts));
      double from_s = begin_s;
      for (int i = 1; i <= parts; ++i) {
        const double to_s = i < parts ? begin_s + (end_s - begin_s) * i / parts : end_s;
        bake_stretch(from_s, to_s, depth + 1);
        from_s = to_s;
      }
      return;
    }
    journal_.add(Gap{begin_s, end_s, static_cast<float>(error_px)});
    note_gap(begin_s, end_s, error_px);
  }

  //! What the blend of two stations misses by at a time between them [px]; 0 where the camera stands still.
  [[nodiscard]] double blending_error(const LensStation& first, const LensStation& last, double time_s) const {
    if (first.r == last.r && first.theta == last.theta) {
      return 0.0;
    }
    const LensView view = view_at(time_s);
    const StationBlend blend(Backend::cpu, on_host(first), on_host(last), view.place);
    return error_of(blend, view, first.leaf_count() > last.leaf_count() ? first : last);
  }

  //! What a station misses by at its own place [px].
  [[nodiscard]] double own_error(const LensStation& station, double time_s) const {
    const StationBlend alone(on_host(station));
    return error_of(alone, view_at(time_s), station);
  }

  static std::shared_ptr<const StationBuffers> on_host(const LensStation& station) {
    return std::make_shared<StationBuffers>(Backend::cpu, station);
  }

  static double error_of(const StationBlend& lens, const LensView& view, const LensStation& sampled) {
    const ScreenError error = measure_screen_error(lens.view(), view, leaf_samples(sampled));
    return std::max(error.p99_px, error.p999_px / far_off);
  }

  const Show& show_;
  const BakeSettings& settings_;
  TrajectoryJournal& journal_;
  const std::function<bool(double)>& proceed_;
  double begin_s_;
  double end_s_;
  double range_ = 0.0;
  std::map<double, std::weak_ptr<const LensStation>> recent_;
  BakeResult result_;
};

}  // namespace

TrajectoryProvenance provenance_of(const Show& show, const BakeSettings& settings) {
  if (find_animation(show, "hole.spin") != nullptr) {
    throw Error(show.name, "the hole's spin changes with time (hole.spin), and lenses are baked for one spin",
                "play and render it with --lens live, or leave the spin as it is");
  }
  // What changes words and tones needs no new lenses.
  Show baked = show;
  baked.timeline = {};
  return {ERGODOME_VERSION, to_toml(baked), show.spin, settings.pixel, settings.budget_px, settings.derivatives};
}

BakeResult bake_trajectory(const Show& show, const BakeSettings& settings, TrajectoryJournal& journal,
                           const std::function<bool(double)>& proceed) {
  return Baker(show, settings, journal, proceed).bake();
}

}  // namespace ergodome
