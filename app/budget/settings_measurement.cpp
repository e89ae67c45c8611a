#include "app/budget/settings_measurement.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>

#include "app/budget/lens_error.h"
#include "app/budget/picture_timer.h"
#include "content/camera/camera_path.h"
#include "content/show/animated_show.h"
#include "kernels/projection/pixel_measure.h"
#include "render/accuracy/axes/picture_race.h"
#include "render/accuracy/statistics.h"
#include "render/eyes/eye_camera.h"
#include "render/passes/sky/sky_shading.h"

namespace ergodome {

namespace {

constexpr int budget_moments = 6;
//! Rows to measure per show time, and pixels in each row; twice as many of both if only one show
//! time is measured.
constexpr int sampled_rows = 32;
constexpr int sampled_columns = 32;
constexpr std::size_t timed_moments = 2;
//! Shares of the time limit in which the work of the stages must be expected to end (exact rays,
//! timed pictures, errors of lenses), to leave time for the later stages.
constexpr double moments_share = 0.25;
constexpr double pictures_share = 0.6;
constexpr double lenses_share = 0.9;
//! Range of the error budgets that lenses are tried with, as factors on the error that the user's
//! budget allows. The first, loosest one exceeds 1, because grids are mostly better than their
//! budget.
constexpr double loosest_lens = 2.0;
constexpr double finest_lens = 0.03;
//! The same range [px] if the user's budget has no error.
constexpr double loosest_px = 0.5;
constexpr double finest_px = 0.015;

//! A time of the show at which errors are measured.
struct BudgetMoment {
  double time_s = 0.0;
  CameraPose pose{};
  Projection projection{};
  std::unique_ptr<LensErrors> errors;
};

//! Times of pictures drawn with one kind of lens and filter.
struct KindTimes {
  LensChoice lens = LensChoice::automatic;
  SkyFilter filter = SkyFilter::ewa;
  PictureTime time;
};

class SettingsMeter {
 public:
  SettingsMeter(ShowRenderer& renderer, const MeasurementOrder& order)
      : renderer_(renderer),
        order_(order),
        deadline_(order.now, order.limit_s),
        first_quality_(renderer.quality()),
        need_(lens_channels(ViewMode::sky, shading_of(renderer.show())).footprint ? PixelNeed::footprint
                                                                                  : PixelNeed::sky) {
    result_.width_px = order.size_px > 0 ? order.size_px : renderer.show().view.size_px;
  }

  SettingsMeasurement measure(const Show& show) {
    find_moments(show);
    check_lens();
    // Times pictures before it measures lenses, which could use up all the time.
    if (has_objects(show, ObjectMethod::polygon) && renderer_.backend() == Backend::cpu) {
      result_.untimed = UntimedFrames::polygons;
    } else {
      time_pictures();
    }
    search(order_.lens);
    const double lens_px = result_.settings.back().quality.budget_px;
    if (order_.lens == LensChoice::automatic && !automatic_is_direct_) {
      search_direct(lens_px);
    }
    add_times();
    renderer_.set_quality(first_quality_);
    result_.cut_short = deadline_.cut_short();
    result_.took_s = deadline_.elapsed_s();
    return std::move(result_);
  }

 private:
  void find_moments(const Show& show) {
    const std::vector<double> times_s = budget_times(show, budget_moments);
    for (const double time_s : times_s) {
      const auto visit = [&] { moments_.push_back(moment_at(show, time_s, times_s.size() > 1 ? 1 : 2)); };
      if (moments_.empty()) {
        visit();
      } else {
        deadline_.run(StartWork::reference, visit, moments_share, 1.0);
      }
    }
    for (const BudgetMoment& moment : moments_) {
      result_.times_s.push_back(moment.time_s);
    }
    const Projection& whole = moments_.front().projection;
    result_.height_to_width = static_cast<double>(whole.height_px) / whole.width_px;
  }

  BudgetMoment moment_at(const Show& show, double time_s, int samples) {
    renderer_.apply(time_s);
    BudgetMoment moment;
    moment.time_s = time_s;
    moment.pose = camera_pose(show, time_s);
    moment.projection = make_projection(renderer_.show().view, result_.width_px, 0.0);
    moment.errors = std::make_unique<LensErrors>(
        eye_camera(renderer_.show(), moment.pose, 0.0), moment.projection,
        row_samples(moment.projection, samples * sampled_rows, samples * sampled_columns, moments_.size() + 1),
        pixel_angle(moment.projection));
    const double next_s = time_s + 1.0 / show.frame_rate_hz;
    const CameraPose next = camera_pose(show, next_s);
    moves_ = moves_ || order_.free_flight || next.r != moment.pose.r || next.theta != moment.pose.theta ||
             spacetime_at(show, next_s) != spacetime_of(renderer_.show());
    return moment;
  }

  //! loosest_budget() returns the coarsest budget of a lens to measure, which is measured first;
  //! finest_budget() returns the finest [px].
  [[nodiscard]] double loosest_budget() const {
    return order_.budget.error_px ? loosest_lens * *order_.budget.error_px : loosest_px;
  }
  [[nodiscard]] double finest_budget() const {
    return order_.budget.error_px ? finest_lens * *order_.budget.error_px : finest_px;
  }

  //! Returns the budget of the lens to measure after `setting`: its budget times the ratio of the
  //! allowed to its measured error, clamped from 0.25 to 0.71; times 0.5 if no error is required.
  [[nodiscard]] double next_budget(const MeasuredSetting& setting) const {
    constexpr double shortest = 0.70710678118654752;
    constexpr double longest = 0.25;
    const double wished = order_.budget.error_px ? kept_share * *order_.budget.error_px / setting.error_px : 0.5;
    return setting.quality.budget_px * std::clamp(wished, longest, shortest);
  }

  //! Measures lenses of one kind, from the coarsest budget to the first that is within the budget's
  //! error, down to finest_budget() at most, or as far as time allows, and adds them to the
  //! settings.
  void search(LensChoice lens) {
    double budget_px = loosest_budget();
    while (budget_px >= finest_budget()) {
      MeasuredSetting setting;
      setting.quality = {budget_px, lens, first_quality_.filter};
      const bool within = measure_lens(setting, lens == order_.lens ? lenses_share : 1.0);
      if (setting.moments == 0) {
        break;  // There is no time left for lenses.
      }
      result_.settings.push_back(setting);
      if (within && order_.budget.error_px) {
        break;
      }
      budget_px = next_budget(setting);
    }
    if (result_.settings.empty()) {
      // Nothing was measured, so use the renderer's budget, at most the coarsest one.
      MeasuredSetting setting;
      setting.quality = {std::min(first_quality_.budget_px, loosest_budget()), lens, first_quality_.filter};
      result_.settings.push_back(setting);
    }
  }

  //! Measures direct rays: if the budget has an error, with the coarsest sufficient budget, as an
  //! alternative to the lens; then with the lens's budget `lens_px`, because `automatic` draws
  //! small pictures with those.
  void search_direct(double lens_px) {
    if (order_.budget.error_px) {
      search(LensChoice::direct);
    }
    MeasuredSetting twin;
    twin.quality = {lens_px, LensChoice::direct, first_quality_.filter};
    if (result_.settings.back().quality != twin.quality) {
      measure_lens(twin, 1.0);
      if (twin.moments > 0) {
        result_.settings.push_back(twin);
      }
    }
  }

  //! Measures the error and the building time of a lens at all moments, until an error exceeds the
  //! budget's or time runs out. Returns whether all were measured and are within it.
  bool measure_lens(MeasuredSetting& setting, double share) {
    std::vector<double> times_ms;
    bool within = true;
    for (std::size_t i = 0; i < moments_.size(); ++i) {
      const BudgetMoment& moment = moments_[i];
      const auto measure = [&] {
        renderer_.apply(moment.time_s);
        renderer_.set_quality(setting.quality);
        const double begun_s = deadline_.elapsed_s();
        const auto lens = renderer_.lens_of(moment.pose, moment.projection, {moment.time_s});
        times_ms.push_back(1000.0 * (deadline_.elapsed_s() - begun_s));
        const double error_px = summary_of(moment.errors->errors(renderer_.backend(), *lens, need_)).p99;
        setting.error_px = std::isnan(setting.error_px) ? error_px : std::max(setting.error_px, error_px);
        ++setting.moments;
      };
      if (!deadline_.run(StartWork::lens, measure, share)) {
        within = false;
        break;
      }
      if (order_.budget.error_px && !is_within(setting.error_px, *order_.budget.error_px)) {
        // The next lens may exceed the error at the same moment of the show, so it is measured
        // there first.
        const auto failed = moments_.begin() + static_cast<std::ptrdiff_t>(i);
        std::rotate(moments_.begin(), failed, failed + 1);
        within = false;
        break;
      }
    }
    const int eyes = drawn_pictures(renderer_.show().stereo);
    setting.lens_ms = times_ms.empty() ? setting.lens_ms : moves_ ? eyes * spread_of(times_ms).median : 0.0;
    return within;
  }

  //! Returns the budget of pictures drawn for timing. It is coarser than the budgets of all lenses
  //! measured later, because the renderer would reuse a finer grid for these lenses instead of
  //! building theirs.
  [[nodiscard]] double coarse_px() const { return 1.1 * loosest_budget(); }

  //! Determines whether the whole picture's lens is one of direct rays although the operator chose
  //! `automatic`.
  void check_lens() {
    const auto visit = [&] {
      const BudgetMoment& moment = moments_.front();
      renderer_.apply(moment.time_s);
      renderer_.set_quality({coarse_px(), order_.lens, first_quality_.filter});
      const auto lens = renderer_.lens_of(moment.pose, moment.projection, {moment.time_s});
      automatic_is_direct_ = order_.lens == LensChoice::automatic && std::string_view(lens->name()) == "direct";
    };
    deadline_.run(StartWork::lens, visit);
  }

  //! Measures the times of pictures for each kind of lens and filter that settings may have. Uses
  //! one budget for all, because the times hardly depend on it.
  void time_pictures() {
    std::vector<TimedMoment> moments;
    for (std::size_t i = 0; i < std::min(timed_moments, moments_.size()); ++i) {
      moments.push_back({moments_[i].time_s, moments_[i].pose});
    }
    PictureTimer timer(renderer_, deadline_, std::move(moments), result_.width_px, pictures_share);
    const auto time_kind = [&](LensChoice lens, SkyFilter filter, LensChoice drawn_by) {
      if (const std::optional<PictureTime> time = timer.time({coarse_px(), drawn_by, filter})) {
        times_.push_back({lens, filter, *time});
        result_.drawn_px = timer.widths_px();
      }
    };
    const bool automatic = order_.lens == LensChoice::automatic;
    const LensChoice drawn_by = !automatic ? order_.lens : automatic_is_direct_ ? LensChoice::direct : LensChoice::live;
    const SkyFilter filter = first_quality_.filter;
    time_kind(order_.lens, filter, drawn_by);
    if (automatic && !automatic_is_direct_) {
      time_kind(LensChoice::direct, filter, LensChoice::direct);
    }
    if (order_.budget.frame_rate_hz && filter == SkyFilter::ewa) {
      time_kind(order_.lens, SkyFilter::point, drawn_by);
    }
    if (times_.empty()) {
      result_.untimed = UntimedFrames::for_time;
      result_.quickest_ms = timer.quickest_ms();
      result_.quickest_px = timer.quickest_px();
    }
  }

  //! Copies the times of pictures to the settings with the same kind of lens and filter. If the
  //! point filter was timed too, first adds a copy of the first setting with that filter.
  void add_times() {
    for (const KindTimes& times : times_) {
      if (times.filter != first_quality_.filter) {
        MeasuredSetting plain = result_.settings.front();
        plain.quality.filter = times.filter;
        result_.settings.push_back(plain);
      }
      for (MeasuredSetting& setting : result_.settings) {
        if (setting.quality.lens == times.lens && setting.quality.filter == times.filter) {
          setting.fixed_ms = times.time.fixed_ms;
          setting.pixels_ms = times.time.pixels_ms;
        }
      }
    }
  }

  ShowRenderer& renderer_;
  const MeasurementOrder& order_;
  Deadline deadline_;
  FrameQuality first_quality_;
  PixelNeed need_;
  std::vector<BudgetMoment> moments_;
  std::vector<KindTimes> times_;
  bool moves_ = false;
  //! True if the renderer uses direct rays for the whole picture with LensChoice::automatic.
  bool automatic_is_direct_ = false;
  SettingsMeasurement result_;
};

}  // namespace

double steady_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::vector<double> budget_times(const Show& show, int count) {
  if (!camera_moves(show) && show.timeline.animations.empty()) {
    return {0.5 * show.duration_s};
  }
  constexpr int sample_count = 400;
  // Finds the minimum of r plus the horizon's radius: near the smaller horizon of a fast spin,
  // light bending has finer detail than at the same r outside a larger one.
  double nearest_s = 0.0;
  double nearest = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= sample_count; ++i) {
    const double time_s = show.duration_s * i / sample_count;
    const double height = camera_pose(show, time_s).r + horizon_radius(spacetime_at(show, time_s));
    if (height < nearest) {
      nearest = height;
      nearest_s = time_s;
    }
  }
  std::vector<double> times_s = {nearest_s};
  for (int i = 0; i + 1 < count; ++i) {
    times_s.push_back(show.duration_s * (i + 0.5) / (count - 1));
  }
  return times_s;
}

SettingsMeasurement measure_settings(ShowRenderer& renderer, const Show& show, const MeasurementOrder& order) {
  return SettingsMeter(renderer, order).measure(show);
}

}  // namespace ergodome
