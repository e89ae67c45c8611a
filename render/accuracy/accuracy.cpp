#include "render/accuracy/accuracy.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <optional>

#include "content/show/animated_show.h"
#include "kernels/core/angles.h"
#include "kernels/launch/instruction_set.h"
#include "kernels/launch/parallel_for.h"
#include "render/accuracy/axes/axes.h"
#include "render/accuracy/axes/picture_race.h"
#include "render/accuracy/statistics.h"
#include "render/passes/sky/sky_shading.h"

namespace ergodome {

namespace {

constexpr double arcmin = one_degree / 60.0;
constexpr const char* closed_form_reference =
    "exact rays in closed form, at one pixel of each cell of a lattice; the error of a direction is its displacement "
    "on the screen";

AccuracyReport head_of(const Show& show, const AccuracySettings& settings, const std::vector<AccuracyMoment>& moments) {
  AccuracyReport report;
  const AccuracyMoment& first = moments.front();
  report.show = show.name;
  report.title = text_in(show.title, "");
  report.machine = fmt::format("CPU, {}, {} threads", name_of(active_instruction_set()), thread_count());
  report.date = fmt::format("{:%Y-%m-%d %H:%M}", fmt::gmtime(std::time(nullptr)));
  report.width_px = first.projection.width_px;
  report.height_px = first.projection.height_px;
  report.pixel_arcmin = first.pixel / arcmin;
  for (const AccuracyMoment& moment : moments) {
    report.times_s.push_back(moment.time_s);
  }
  report.samples = static_cast<int>(pixel_lattice(first.projection, settings.lattice, settings.seed).pixels.size());
  report.rounds = settings.rounds;
  return report;
}

//! Returns notes about how a show was measured, and which parts of it were not.
std::vector<std::string> notes_of(const Show& show, const AccuracySettings& settings) {
  std::vector<std::string> notes = {
      "everything was measured on the CPU, nothing on a GPU",
      "the conforming grid is read for several pixels at once (SIMD), but the published quadtree for one pixel at a "
      "time, because it uses a hash table"};
  if (eye_count(show.stereo) > 1) {
    notes.emplace_back(
        "the show is stereoscopic, but only the stereo models are measured with two eyes; all else is measured with "
        "one eye at the center of the head");
  }
  if (settings.quick && draws_slowly(show)) {
    notes.emplace_back(
        "complete frames, and disk, shells and objects, were not measured, because the objects take seconds to draw "
        "without a GPU; omit --quick to measure them");
  }
  return notes;
}

bool has_footprints(const Show& show) { return lens_channels(ViewMode::sky, shading_of(show)).footprint; }

bool has_near_things(const Show& show) { return show.disk || !show.shells.empty() || !show.objects.empty(); }

//! Returns whether the axis `name` applies to a show. If `quick`, the axes `near` and `frame` do
//! not apply to shows that draw slowly (draws_slowly()).
bool has_axis(const std::string& name, const Show& show, bool quick) {
  if (name == "lens") {
    return has_footprints(show);
  }
  if (name == "stations") {
    return has_stations(show);
  }
  if (name == "stereo") {
    return eye_count(show.stereo) > 1;
  }
  if (name == "stars") {
    return !show.sky.stars.empty();
  }
  if (name == "near") {
    return has_near_things(show) && !(quick && draws_slowly(show));
  }
  return name != "frame" || !(quick && draws_slowly(show));
}

std::optional<AccuracyAxis> measure_axis(const std::string& name, const Show& show,
                                         const std::vector<AccuracyMoment>& moments, const AccuracySettings& settings,
                                         const AccuracyProgress& progress) {
  if (name == "rays") {
    return AccuracyAxis{"rays",
                        "Direction of the light of each pixel",
                        ErrorUnit::pixels,
                        closed_form_reference,
                        "taylor",
                        measure_lenses(sky_choices(settings.quick), PixelNeed::sky, moments, settings, progress)};
  }
  if (name == "lens") {
    return AccuracyAxis{
        "lens",
        "Direction and footprint of each pixel on the sky, for the filter of the sky map",
        ErrorUnit::pixels,
        closed_form_reference,
        "conforming grid",
        measure_lenses(footprint_choices(settings.quick), PixelNeed::footprint, moments, settings, progress)};
  }
  if (name == "stations") {
    return measure_stations(show, moments, settings, progress);
  }
  if (name == "stereo") {
    return measure_stereo(show, has_footprints(show) ? PixelNeed::footprint : PixelNeed::sky, moments, settings,
                          progress);
  }
  if (name == "near") {
    return measure_near(show, settings, progress);
  }
  if (name == "stars") {
    return measure_stars(show, moments, settings, progress);
  }
  return name == "map" ? measure_map(show, settings, progress) : measure_frames(show, settings, progress);
}

}  // namespace

std::vector<std::string> accuracy_axes(const Show& show, const AccuracySettings& settings) {
  std::vector<std::string> names;
  for (const std::string name : accuracy_axis_names) {
    const bool asked = settings.axes.empty() || std::ranges::find(settings.axes, name) != settings.axes.end();
    if (asked && has_axis(name, show, settings.quick)) {
      names.push_back(name);
    }
  }
  return names;
}

AccuracySettings quick_settings() {
  AccuracySettings settings;
  settings.max_px = 384;
  settings.moments = 1;
  settings.rounds = 3;
  settings.lattice = 128;
  settings.quick = true;
  return settings;
}

AccuracyReport measure_accuracy(const Show& show, const AccuracySettings& settings, const AccuracyProgress& progress) {
  const Stopwatch watch;
  const std::vector<AccuracyMoment> moments = accuracy_moments(show, settings);
  AccuracyReport report = head_of(show, settings, moments);
  for (const std::string& name : accuracy_axes(show, settings)) {
    if (std::optional<AccuracyAxis> axis = measure_axis(name, show, moments, settings, progress)) {
      report.axes.push_back(std::move(*axis));
    } else {
      report.notes.emplace_back(
          name == "stations"
              ? "stations were not measured, because the camera does not move at the measured moments"
              : "stereo models were not measured, because both eyes are at the same position at the measured moments");
    }
  }
  const std::vector<std::string> notes = notes_of(show, settings);
  report.notes.insert(report.notes.end(), notes.begin(), notes.end());
  for (AccuracyAxis& axis : report.axes) {
    mark_pareto(axis);
  }
  report.took_s = 1e-3 * watch.elapsed_ms();
  return report;
}

}  // namespace ergodome
