#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "content/camera/camera_path.h"
#include "content/show/animated_show.h"
#include "content/trajectory/station_codec.h"
#include "render/accuracy/axes/axes.h"
#include "render/accuracy/lenses/source_lens.h"
#include "render/lens/grid/grid_builder.h"
#include "render/lens/grid/grid_lens.h"
#include "render/lens/lens_source.h"

namespace ergodome {

namespace {

//! A part of the camera's path on which r and θ are monotonic.
struct Leg {
  double begin_s = 0.0;
  double end_s = 0.0;
};

//! Returns the legs of a show's camera path, without those at whose ends r and θ are the same.
std::vector<Leg> legs_of(const Show& show) {
  const std::vector<double> ends_s = path_ends_s(show);
  std::vector<Leg> legs;
  for (std::size_t i = 0; i + 1 < ends_s.size(); ++i) {
    const CameraPose from = camera_pose(show, ends_s[i]);
    const CameraPose to = camera_pose(show, ends_s[i + 1]);
    if (from.r != to.r || from.theta != to.theta) {
      legs.push_back({ends_s[i], ends_s[i + 1]});
    }
  }
  return legs;
}

//! Returns the leg that contains a time; nothing if r and θ are constant at that time.
std::optional<Leg> leg_at(const Show& show, double time_s) {
  for (const Leg& leg : legs_of(show)) {
    if (time_s >= leg.begin_s && time_s <= leg.end_s) {
      return leg;
    }
  }
  return std::nullopt;
}

using StationPointer = std::shared_ptr<const StationBuffers>;

//! Measures the lens that is blended from two stations around a moment; blends them again for each
//! frame, as the renderer does with streamed stations.
class StationPixels : public PixelLens {
 public:
  StationPixels(LensScene& scene, double spacing_s, bool derivatives) : scene_(scene), pixels_(scene.pixels()) {
    const AccuracyMoment& moment = scene.moment();
    const Leg leg = leg_at(moment.show, moment.time_s).value_or(Leg{moment.time_s, moment.time_s});
    const double latest_s = std::max(leg.end_s - spacing_s, leg.begin_s);
    const double begin_s = std::clamp(moment.time_s - 0.5 * spacing_s, leg.begin_s, latest_s);
    for (const double time_s : {begin_s, std::min(begin_s + spacing_s, leg.end_s)}) {
      stations_.push_back(build(time_s, derivatives));
    }
  }

  void draw() override {
    const EyeCamera& eye = scene_.eye();
    const GridLens lens(Backend::cpu, "streamed",
                        StationBlend(Backend::cpu, buffers_[0], buffers_[1], {eye.r, eye.theta}), eye,
                        scene_.projection(), 0.2 * budget_px());
    lens.fill(0, scene_.projection().height_px, pixels_);
  }

  [[nodiscard]] std::optional<Vector3<double>> sky(std::int64_t pixel) const override {
    return seen_in(pixels_, pixel);
  }
  [[nodiscard]] std::size_t bytes() const override { return buffers_[0]->bytes(); }
  [[nodiscard]] std::optional<std::size_t> disk_bytes() const override {
    return pack_station(stations_.front()).bytes.size();
  }

 private:
  [[nodiscard]] double budget_px() const { return scene_.moment().show.quality.budget_px; }

  LensStation build(double time_s, bool derivatives) {
    const AccuracyMoment& moment = scene_.moment();
    const EyeCamera eye = eye_camera(moment.show, camera_pose(moment.show, time_s), 0.0);
    GridSettings settings;
    settings.pixel = moment.pixel;
    settings.budget_px = budget_px();
    settings.observer = aberration_to_rain(eye.spacetime, eye.r, eye.theta, eye.motion, eye.velocity);
    settings.fine = settings.budget_px * settings.pixel < finest_float_budget;
    settings.derivatives = derivatives;
    LensStation station = build_lens_station(eye.spacetime, eye.r, eye.theta, settings);
    buffers_.push_back(std::make_shared<const StationBuffers>(Backend::cpu, station));
    return station;
  }

  LensScene& scene_;
  LensPixels pixels_;
  std::vector<StationPointer> buffers_;
  std::vector<LensStation> stations_;
};

LensChoiceToMeasure station_choice(double spacing_s, bool derivatives) {
  return {derivatives ? "stations with derivatives" : "plain stations",
          fmt::format("one station every {:.2g} s", spacing_s), "", "",
          [=](LensScene& scene) { return std::make_unique<StationPixels>(scene, spacing_s, derivatives); }};
}

//! Converts results for two stations to results for all stations that one second of the show needs.
//! frame_ms, the time to blend two stations and read every pixel, moves to passes_ms; the time to
//! build all stations replaces it, computed from prepare_ms, the time to build two. disk_bytes, the
//! size of one station, becomes the size of all. memory_bytes remains that of one station.
void count_a_second(Measurement& choice, double spacing_s) {
  choice.passes_ms["blending two stations and reading every pixel"] = spread_of(choice.frame_ms).median;
  for (std::size_t i = 0; i < choice.frame_ms.size(); ++i) {
    choice.frame_ms[i] = 0.5 * choice.prepare_ms[i] / spacing_s;
  }
  choice.prepare_ms.clear();
  if (choice.disk_bytes) {
    choice.disk_bytes = static_cast<std::size_t>(std::lround(static_cast<double>(*choice.disk_bytes) / spacing_s));
  }
}

}  // namespace

bool has_stations(const Show& show) {
  if (find_animation(show, "hole.spin") != nullptr || show.grid_scheme != GridScheme::conforming) {
    return false;
  }
  return !legs_of(show).empty();
}

std::optional<AccuracyAxis> measure_stations(const Show& show, const std::vector<AccuracyMoment>& moments,
                                             const AccuracySettings& settings, const AccuracyProgress& progress) {
  if (!has_stations(show)) {
    return std::nullopt;
  }
  std::vector<AccuracyMoment> moving;
  double shortest_s = show.duration_s;
  for (const AccuracyMoment& moment : moments) {
    if (const std::optional<Leg> leg = leg_at(show, moment.time_s)) {
      shortest_s = std::min(shortest_s, leg->end_s - leg->begin_s);
      moving.push_back(moment);
    }
  }
  if (moving.empty()) {
    return std::nullopt;
  }
  std::vector<LensChoiceToMeasure> choices;
  std::vector<double> spacings_s;
  for (const bool derivatives : {true, false}) {
    for (const double part : {0.5, 0.25, 0.125, 0.0625, 0.03125}) {
      spacings_s.push_back(part * shortest_s);
      choices.push_back(station_choice(part * shortest_s, derivatives));
    }
  }
  AccuracyAxis axis;
  axis.name = "stations";
  axis.title = "Spacing of stations (lenses computed before the show)";
  axis.unit = ErrorUnit::pixels;
  axis.reference =
      "rays in closed form, halfway between two stations. A station is a camera position whose lens is computed in "
      "advance. Memory is that of one station; disk space is that of one second of the show";
  axis.time = "of baking per second of the show";
  axis.choices = measure_lenses(choices, PixelNeed::sky, moving, settings, progress);
  for (std::size_t i = 0; i < axis.choices.size(); ++i) {
    count_a_second(axis.choices[i], spacings_s[i]);
  }
  return axis;
}

}  // namespace ergodome
