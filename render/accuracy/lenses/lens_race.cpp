#include "render/accuracy/lenses/lens_race.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>

#include "kernels/core/error.h"
#include "render/accuracy/references/pixel_reference.h"
#include "render/accuracy/statistics.h"

namespace ergodome {

namespace {

//! Frames slower than this [ms] are drawn only twice: once to warm up, which is used as the first
//! round, and once in the second round. The change of their errors from frame to frame is not
//! measured.
constexpr double slow_ms = 1500.0;
constexpr double slow_for_a_quick_look_ms = 400.0;
constexpr std::size_t slow_round = 1;
//! Frames faster than this [ms] are easily delayed by any other program. One run of them is the
//! fastest of several successive tries.
constexpr double short_ms = 50.0;
constexpr int short_tries = 3;

//! Results of one method so far, over all moments.
struct Entry {
  std::vector<double> errors;
  std::vector<double> flickers;
  std::size_t lost = 0;
  double warm_up_ms = 0.0;  //!< time of the warm-up frame, at the current moment
  //! true if the warm-up frame took more than `slow_ms` (with --quick, `slow_for_a_quick_look_ms`)
  bool slow = false;
  //! Times of preparation and frames, by moment, and for each moment by round.
  std::vector<std::vector<double>> prepare_ms;
  std::vector<std::vector<double>> frame_ms;
  //! Errors of all compared pixels at the current moment, as displacements in the view's axes [px].
  std::vector<Vector3<double>> misses;
};

//! Returns, for each round, the mean of the times over the moments. Omits rounds that some moments
//! lack.
std::vector<double> means_of(const std::vector<std::vector<double>>& moments) {
  std::vector<double> means = moments.empty() ? std::vector<double>() : moments.front();
  for (std::size_t i = 1; i < moments.size(); ++i) {
    means.resize(std::min(means.size(), moments[i].size()));
    for (std::size_t round = 0; round < means.size(); ++round) {
      means[round] += moments[i][round];
    }
  }
  for (double& mean : means) {
    mean /= static_cast<double>(moments.size());
  }
  return means;
}

double length(const Vector3<double>& v) { return std::sqrt(dot(v, v)); }

//! Returns, for all compared pixels, the displacements on the screen of what the lens shows
//! (PixelReference::miss()); zero for pixels for which PixelReference::counts() is false.
std::vector<Vector3<double>> misses_of(const PixelLens& lens, const PixelReference& reference,
                                       const PixelLattice& lattice) {
  std::vector<Vector3<double>> misses(reference.size());
  for (std::size_t i = 0; i < reference.size(); ++i) {
    misses[i] = reference.counts(i) ? reference.miss(i, lens.sky(lattice.pixels[i])) : Vector3<double>{};
  }
  return misses;
}

//! Compares a method's last draw with the reference, and stores the errors in `entry` and `map`.
//! Ignores pixels for which PixelReference::counts() is false, and pixels that are dark in both the
//! draw and the reference.
void read_errors(const PixelLens& lens, const PixelReference& reference, const PixelLattice& lattice, Entry& entry,
                 ErrorMap& map) {
  entry.misses = misses_of(lens, reference, lattice);
  map.width = lattice.columns;
  map.height = lattice.rows;
  map.error.assign(reference.size(), std::numeric_limits<float>::quiet_NaN());
  for (std::size_t i = 0; i < reference.size(); ++i) {
    const bool seen = reference.counts(i) && lens.sky(lattice.pixels[i]).has_value();
    if (reference.counts(i) && (reference.is_lit(i) || seen)) {
      entry.errors.push_back(length(entry.misses[i]));
      entry.lost += seen ? 0 : 1;
      map.error[i] = static_cast<float>(entry.errors.back());
    }
  }
}

class LensRace {
 public:
  LensRace(const std::vector<LensChoiceToMeasure>& choices, PixelNeed need, const AccuracySettings& settings,
           const AccuracyProgress& progress)
      : choices_(choices),
        need_(need),
        settings_(settings),
        progress_(progress),
        entries_(choices.size()),
        results_(choices.size()) {
    for (std::size_t i = 0; i < choices.size(); ++i) {
      results_[i].method = choices[i].method;
      results_[i].setting = choices[i].setting;
      results_[i].precision = choices[i].precision;
      results_[i].published = choices[i].published;
    }
  }

  //! Measures errors and times of all methods at a moment.
  void run(const AccuracyMoment& moment) {
    report_progress(progress_, "reference rays");
    lattice_ = pixel_lattice(moment.projection, settings_.lattice, settings_.seed);
    LensScene scene(moment, FrameOfMoment::now, need_);
    const PixelReference now(moment.eye, moment.projection, lattice_.pixels, moment.pixel);
    for (std::size_t i = 0; i < choices_.size(); ++i) {
      warm_up(i, scene, now);
    }
    see_flicker(moment, now);
    for (std::size_t round = 0; round < static_cast<std::size_t>(settings_.rounds); ++round) {
      for (std::size_t i = 0; i < choices_.size(); ++i) {
        time(i, scene, round);
      }
    }
    first_moment_ = false;
  }

  std::vector<Measurement> results(std::size_t moments) {
    for (std::size_t i = 0; i < choices_.size(); ++i) {
      Measurement& result = results_[i];
      Entry& entry = entries_[i];
      result.lost =
          entry.errors.empty() ? 0.0 : static_cast<double>(entry.lost) / static_cast<double>(entry.errors.size());
      result.error = summary_of(std::move(entry.errors));
      if (!entry.flickers.empty()) {
        result.flicker = summary_of(std::move(entry.flickers)).p99;
      }
      result.memory_bytes /= moments;
      result.prepare_ms = means_of(entry.prepare_ms);
      result.frame_ms = means_of(entry.frame_ms);
    }
    return std::move(results_);
  }

 private:
  void warm_up(std::size_t i, LensScene& scene, const PixelReference& now) {
    report_progress(progress_, choices_[i].method + ", " + choices_[i].setting);
    entries_[i].prepare_ms.emplace_back();
    entries_[i].frame_ms.emplace_back();
    const Stopwatch whole;
    const std::unique_ptr<PixelLens> lens = choices_[i].make(scene);
    const double prepared_ms = whole.elapsed_ms();
    const Stopwatch watch;
    lens->draw();
    entries_[i].warm_up_ms = watch.elapsed_ms();
    entries_[i].slow = entries_[i].warm_up_ms > (settings_.quick ? slow_for_a_quick_look_ms : slow_ms);
    if (entries_[i].slow) {
      add_run(i, prepared_ms, entries_[i].warm_up_ms);
    }
    ErrorMap map;
    read_errors(*lens, now, lattice_, entries_[i], map);
    results_[i].memory_bytes += lens->bytes();
    if (first_moment_) {
      results_[i].map = std::move(map);
      results_[i].disk_bytes = lens->disk_bytes();
    }
  }

  void see_flicker(const AccuracyMoment& moment, const PixelReference& now) {
    report_progress(progress_, "the next frame");
    LensScene scene(moment, FrameOfMoment::next, need_);
    const PixelReference next(moment.next, moment.projection, lattice_.pixels, moment.pixel);
    for (std::size_t i = 0; i < choices_.size(); ++i) {
      if (entries_[i].slow) {
        continue;
      }
      report_progress(progress_, choices_[i].method + ", " + choices_[i].setting);
      const std::unique_ptr<PixelLens> lens = choices_[i].make(scene);
      lens->draw();
      const std::vector<Vector3<double>> misses = misses_of(*lens, next, lattice_);
      for (std::size_t k = 0; k < misses.size(); ++k) {
        if (now.counts(k) && next.counts(k) && now.is_lit(k) && next.is_lit(k)) {
          entries_[i].flickers.push_back(length(misses[k] - entries_[i].misses[k]));
        }
      }
    }
  }

  void time(std::size_t i, LensScene& scene, std::size_t round) {
    if (entries_[i].slow && round != slow_round) {
      return;
    }
    report_progress(progress_, choices_[i].method + ", " + choices_[i].setting);
    double prepared_ms = std::numeric_limits<double>::infinity();
    double frame_ms = prepared_ms;
    for (int attempt = 0; attempt < (entries_[i].warm_up_ms < short_ms ? short_tries : 1); ++attempt) {
      const Stopwatch whole;
      const std::unique_ptr<PixelLens> lens = choices_[i].make(scene);
      prepared_ms = std::min(prepared_ms, whole.elapsed_ms());
      const Stopwatch frame;
      lens->draw();
      frame_ms = std::min(frame_ms, frame.elapsed_ms());
    }
    add_run(i, prepared_ms, frame_ms);
  }

  void add_run(std::size_t i, double prepared_ms, double frame_ms) {
    entries_[i].prepare_ms.back().push_back(prepared_ms);
    entries_[i].frame_ms.back().push_back(frame_ms);
  }

  const std::vector<LensChoiceToMeasure>& choices_;
  PixelNeed need_;
  const AccuracySettings& settings_;
  const AccuracyProgress& progress_;
  std::vector<Entry> entries_;
  std::vector<Measurement> results_;
  PixelLattice lattice_;
  bool first_moment_ = true;
};

}  // namespace

void report_progress(const AccuracyProgress& progress, const std::string& doing) {
  if (progress && !progress(doing)) {
    throw Error("accuracy", "stopped; nothing was written", "run it again");
  }
}

std::vector<Measurement> measure_lenses(const std::vector<LensChoiceToMeasure>& choices, PixelNeed need,
                                        const std::vector<AccuracyMoment>& moments, const AccuracySettings& settings,
                                        const AccuracyProgress& progress) {
  LensRace race(choices, need, settings, progress);
  for (const AccuracyMoment& moment : moments) {
    race.run(moment);
  }
  return race.results(std::max<std::size_t>(moments.size(), 1));
}

namespace {

constexpr double tolerances_px[] = {0.05, 0.005};
constexpr double budgets_px[] = {1.0, 0.25, 0.1, 0.05, 0.025};

//! Returns the finest levels to measure for the published quadtree grid (Verbraeck & Eisemann
//! 2021). Its authors use levels up to 10, which are too coarse for errors of a tenth of a pixel in
//! a large picture.
std::vector<int> levels(bool quick) {
  return quick ? std::vector<int>{8, 9, 10, 11} : std::vector<int>{9, 10, 11, 12, 13};
}

void add_own(std::vector<LensChoiceToMeasure>& choices) {
  for (const double tolerance_px : tolerances_px) {
    choices.push_back(direct_choice(tolerance_px));
  }
  for (const double budget_px : budgets_px) {
    choices.push_back(grid_choice(budget_px));
  }
}

void add_rays(std::vector<LensChoiceToMeasure>& choices, TraceMethod method, bool narrow,
              std::initializer_list<double> tolerances) {
  for (const double tolerance : tolerances) {
    choices.push_back(ray_choice(method, narrow, tolerance));
  }
}

}  // namespace

std::vector<LensChoiceToMeasure> sky_choices(bool quick) {
  std::vector<LensChoiceToMeasure> choices;
  add_own(choices);
  for (const int level : levels(quick)) {
    choices.push_back(quadtree_choice(level, false));
    choices.push_back(quadtree_choice(level, true));
  }
  add_rays(choices, TraceMethod::taylor, true, {1e-3, 1e-4, 1e-5, 1e-6});
  add_rays(choices, TraceMethod::taylor, false, {1e-5, 1e-7, 1e-10});
  add_rays(choices, TraceMethod::cash_karp, true, {1e-1, 1e-2, 1e-3, 1e-5});
  add_rays(choices, TraceMethod::cash_karp, false, {1e-3, 1e-5, 1e-7});
  add_rays(choices, TraceMethod::rk34, true, {1e-2, 1e-3, 1e-4, 1e-5});
  add_rays(choices, TraceMethod::rk34, false, {1e-3, 1e-5});
  add_rays(choices, TraceMethod::baseline_rk34, true, {1e-2, 1e-3, 1e-4});
  add_rays(choices, TraceMethod::baseline_rk34, false, {1e-3, 1e-4});
  if (!quick) {
    add_rays(choices, TraceMethod::cash_karp, false, {1e-9});
    add_rays(choices, TraceMethod::rk34, false, {1e-7});
    add_rays(choices, TraceMethod::baseline_rk34, true, {1e-5});
    add_rays(choices, TraceMethod::baseline_rk34, false, {1e-5});
  }
  choices.push_back(ray_choice(TraceMethod::closed_form, false, 0.0));
  return choices;
}

std::vector<LensChoiceToMeasure> footprint_choices(bool quick) {
  std::vector<LensChoiceToMeasure> choices;
  add_own(choices);
  for (const int level : levels(quick)) {
    choices.push_back(quadtree_pixel_choice(level));
  }
  return choices;
}

}  // namespace ergodome
