#include "render/stereo/reduced_baseline.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "content/show/animated_show.h"
#include "content/show/show_errors.h"
#include "content/show/stereo_eyes.h"
#include "kernels/core/error.h"
#include "render/stereo/eye_distance.h"

namespace ergodome {

namespace {

//! Returns the reduced baseline at a show time. Returns nothing if the show's baseline fits, or if
//! the camera itself cannot be at its position, which is reported elsewhere.
std::optional<ReducedBaseline> reduced_baseline_at(const Show& show, double time_s) {
  const Show now = show_at(show, time_s);
  const CameraPose pose = camera_pose(now, time_s);
  ReducedBaseline eyes = {now.stereo.model, pose.r, now.stereo.baseline, now.stereo.baseline};
  try {
    eyes.baseline = fitting_baseline(now, pose);
  } catch (const Error&) {
    return std::nullopt;
  }
  return eyes.baseline < eyes.asked ? std::optional(eyes) : std::nullopt;
}

//! Returns the show times at which the baseline is checked, in order [s].
std::vector<double> times_of_eyes(const Show& show) {
  constexpr int max_times = 32;
  if (!camera_moves(show) && show.timeline.animations.empty()) {
    return {0.0};
  }
  std::vector<double> times = path_ends_s(show);
  if (times.size() > max_times / 2) {
    times.clear();
  }
  for (int i = 0; i <= max_times; ++i) {
    times.push_back(show.duration_s * i / max_times);
  }
  std::ranges::sort(times);
  return times;
}

//! Returns the time between `before_s` and `after_s` at which the reduction of the baseline begins,
//! accurate to 0.01 s [s].
double beginning_s(const Show& show, double before_s, double after_s) {
  constexpr double exact_s = 0.01;
  while (after_s - before_s > exact_s) {
    const double middle_s = 0.5 * (before_s + after_s);
    (reduced_baseline_at(show, middle_s) ? after_s : before_s) = middle_s;
  }
  return after_s;
}

std::string sentence(const Show& show, const std::string& problem) {
  const Error error("stereo.baseline", problem,
                    "for a constant baseline, choose a smaller one, or model = \"physical\"");
  for (const char* const key : {"stereo.baseline", "animate.stereo.baseline"}) {
    if (show.lines.contains(key)) {
      return named_by(show, key, error).what();
    }
  }
  return error.what();
}

std::string closer(double time_s, const ReducedBaseline& eyes) {
  return fmt::format(
      "a baseline of {:.4g} M is too large for the model {} at {:.6g} s, r = {:.4g} M: it is reduced to {:.4g} M",
      eyes.asked, stereo_model_names[static_cast<std::size_t>(eyes.model)], time_s, eyes.r, eyes.baseline);
}

}  // namespace

std::optional<BaselineReductions> baseline_reductions(const Show& show) {
  if (eye_count(show.stereo) < 2 || fits_everywhere(show.stereo.model)) {
    return std::nullopt;
  }
  std::optional<BaselineReductions> path;
  double before_s = 0.0;
  for (const double time_s : times_of_eyes(show)) {
    const std::optional<ReducedBaseline> eyes = reduced_baseline_at(show, time_s);
    if (eyes && !path) {
      const double first_s = beginning_s(show, before_s, time_s);
      path = {first_s, reduced_baseline_at(show, first_s).value_or(*eyes), time_s, *eyes};
    } else if (eyes && eyes->baseline < path->smallest.baseline) {
      path->smallest_s = time_s;
      path->smallest = *eyes;
    }
    before_s = time_s;
  }
  return path;
}

std::string note_of(const Show& show, double time_s, const ReducedBaseline& eyes) {
  return sentence(show, closer(time_s, eyes));
}

std::string note_of(const Show& show, const BaselineReductions& path) {
  std::string text = closer(path.first_s, path.first);
  if (path.smallest.baseline < path.first.baseline) {
    text += fmt::format(", and to {:.4g} M at {:.6g} s, r = {:.4g} M", path.smallest.baseline, path.smallest_s,
                        path.smallest.r);
  }
  return sentence(show, text);
}

}  // namespace ergodome
