#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "content/show/animated_show.h"
#include "kernels/core/angles.h"
#include "render/accuracy/axes/axes.h"
#include "render/accuracy/lenses/source_lens.h"
#include "render/eyes/view_projection.h"
#include "render/lens/direct_lens.h"
#include "render/lens/flat/flat_shadow.h"
#include "render/lens/grid/edge_table.h"
#include "render/lens/lens_chooser.h"
#include "render/lens/omni_chooser.h"
#include "render/passes/flat_shadow/shadow_mask.h"

namespace ergodome {

namespace {

//! Distances of the eyes to the right of the head, in baselines: first the right eye, then the left
//! eye, whose result is compared.
constexpr double sides[] = {0.5, -0.5};

//! Returns the projection of both eyes without the shift of their pictures for convergence.
Projection head_projection(const LensScene& scene) {
  return make_projection(scene.moment().show.view, scene.projection().width_px, 0.0);
}

Projection own_projection(const LensScene& scene, double side) {
  const StereoSettings& stereo = scene.moment().show.stereo;
  return converged_projection(head_projection(scene), side * stereo.baseline, stereo.convergence);
}

//! Measures the lenses of both eyes. Both lenses write to the same memory, the left eye's last, so
//! that the left eye's result is compared.
class PairPixels : public PixelLens {
 public:
  PairPixels(LensScene& scene, std::vector<std::unique_ptr<LensSource>> sources)
      : pixels_(scene.pixels()), height_px_(scene.projection().height_px), sources_(std::move(sources)) {}

  void draw() override {
    for (const auto& source : sources_) {
      source->fill(0, height_px_, pixels_);
    }
  }

  [[nodiscard]] std::optional<Vector3<double>> sky(std::int64_t pixel) const override {
    return seen_in(pixels_, pixel);
  }

 private:
  LensPixels pixels_;
  int height_px_;
  std::vector<std::unique_ptr<LensSource>> sources_;
};

//! Measures the eyes of the stereo model `flat`: both eyes read the lens of the head's camera, and
//! each eye's picture is masked with the shadow that this eye sees.
class FlatPixels : public PairPixels {
 public:
  FlatPixels(LensScene& scene, std::vector<std::unique_ptr<LensSource>> sources)
      : PairPixels(scene, std::move(sources)),
        head_(eye_camera(scene.moment().show, scene.pose(), 0.0)),
        baseline_(scene.moment().show.stereo.baseline) {
    for (const double side : sides) {
      projections_.push_back(own_projection(scene, side));
    }
    light_.width = scene.projection().width_px;
    light_.height = scene.projection().height_px;
  }

  void draw() override {
    PairPixels::draw();
    const FlatShadow shadow(head_);
    for (std::size_t i = 0; i < std::size(sides); ++i) {
      light_.rgba.assign(4 * static_cast<std::size_t>(light_.width) * static_cast<std::size_t>(light_.height), 1.0F);
      const std::vector<float> edge = shadow.eye_edge(sides[i] * baseline_);
      mask_shadow(light_, projections_[i], edge_view(shadow.chart(), shadow.head_edge()),
                  edge_view(shadow.chart(), edge));
    }
  }

  [[nodiscard]] std::optional<Vector3<double>> sky(std::int64_t pixel) const override {
    const bool lit = light_.rgba[4 * static_cast<std::size_t>(pixel)] > 0.5F;
    return lit ? PairPixels::sky(pixel) : std::nullopt;
  }

 private:
  EyeCamera head_;
  double baseline_;
  std::vector<Projection> projections_;
  Picture light_;  //!< picture whose pixels become dark where the eye sees the shadow
};

//! A way to compute a lens: its source and accuracy.
struct LensWay {
  LensChoice choice;
  LensAccuracy accuracy;
  std::string name;
};

//! Creates the lens that the renderer would use.
std::unique_ptr<LensSource> lens_of(const LensWay& way, LensChooser& chooser, const EyeCamera& eye,
                                    const Projection& projection) {
  return chooser.choose({way.choice, eye, projection, ViewMode::sky, way.accuracy, {}, GridScheme::conforming});
}

std::unique_ptr<PixelLens> make_physical(LensScene& scene, const LensWay& way) {
  LensChooser chooser(Backend::cpu);
  std::vector<std::unique_ptr<LensSource>> sources;
  for (const double side : sides) {
    const EyeCamera eye = eye_camera(scene.moment().show, scene.pose(), side * scene.moment().show.stereo.baseline);
    sources.push_back(lens_of(way, chooser, eye, own_projection(scene, side)));
  }
  return std::make_unique<PairPixels>(scene, std::move(sources));
}

std::unique_ptr<PixelLens> make_flat(LensScene& scene, const LensWay& way) {
  LensChooser chooser(Backend::cpu);
  const EyeCamera head = eye_camera(scene.moment().show, scene.pose(), 0.0);
  std::vector<std::unique_ptr<LensSource>> sources;
  for (int i = 2 - flat_pictures(scene.moment().show.stereo); i < 2; ++i) {
    sources.push_back(lens_of(way, chooser, head, own_projection(scene, sides[i])));
  }
  return std::make_unique<FlatPixels>(scene, std::move(sources));
}

std::unique_ptr<PixelLens> make_omni(LensScene& scene, const LensWay& way) {
  const StereoSettings& stereo = scene.moment().show.stereo;
  const EyeAtOffset eye_at = [&](const Vector3<double>& offset) {
    return eye_camera(scene.moment().show, scene.pose(), offset);
  };
  const OmniSettings settings = {0.5 * stereo.baseline, stereo.convergence, one_degree * stereo.fade_from_deg,
                                 one_degree * stereo.fade_to_deg, way.accuracy.tolerance_px * scene.moment().pixel};
  const auto cameras = std::make_shared<const OmniCamera>(Backend::cpu, eye_at, settings);
  OmniChooser chooser(Backend::cpu);
  std::vector<std::unique_ptr<LensSource>> sources;
  for (const double side : sides) {
    sources.push_back(chooser.choose(make_omni_eye(cameras, 2.0 * side, eye_at), head_projection(scene), ViewMode::sky,
                                     way.choice, way.accuracy));
  }
  return std::make_unique<PairPixels>(scene, std::move(sources));
}

std::vector<LensChoiceToMeasure> stereo_choices(bool quick) {
  std::vector<LensWay> ways = {{LensChoice::live, {0.25, 0.05}, "grid, budget 0.25 px"},
                               {LensChoice::direct, {0.25, 0.05}, "direct rays, tolerance 0.05 px"}};
  if (!quick) {
    ways.push_back({LensChoice::live, {0.05, 0.01}, "grid, budget 0.05 px"});
  }
  std::vector<LensChoiceToMeasure> choices;
  for (const LensWay& way : ways) {
    choices.push_back({"physical", way.name, "", "", [=](LensScene& scene) { return make_physical(scene, way); }});
    choices.push_back({"flat", way.name, "", "HP", [=](LensScene& scene) { return make_flat(scene, way); }});
    choices.push_back({"omni", way.name, "", "", [=](LensScene& scene) { return make_omni(scene, way); }});
  }
  return choices;
}

//! Returns the moment with the left eye instead of the head.
AccuracyMoment left_eye_of(AccuracyMoment moment) {
  const StereoSettings& stereo = moment.show.stereo;
  const double offset = -0.5 * stereo.baseline;
  moment.eye = eye_camera(moment.show, moment.pose, offset);
  moment.next = eye_camera(moment.show, moment.next_pose, offset);
  moment.projection = converged_projection(moment.projection, offset, stereo.convergence);
  return moment;
}

}  // namespace

std::optional<AccuracyAxis> measure_stereo(const Show& show, PixelNeed need, const std::vector<AccuracyMoment>& moments,
                                           const AccuracySettings& settings, const AccuracyProgress& progress) {
  std::vector<AccuracyMoment> left;
  for (const AccuracyMoment& moment : moments) {
    if (eye_count(show.stereo) > 1 && moment.show.stereo.baseline > 0.0) {
      left.push_back(left_eye_of(moment));
    }
  }
  if (left.empty()) {
    return std::nullopt;
  }
  AccuracyAxis axis;
  axis.name = "stereo";
  axis.title = "Positions of the eyes in stereo models";
  axis.unit = ErrorUnit::pixels;
  axis.reference = fmt::format(
      "the left of two real eyes, {:g} M apart, each with its own camera, with rays in closed form. The models flat "
      "and omni place the eyes differently on purpose, so their errors show that difference",
      left.front().show.stereo.baseline);
  axis.time = "per frame, for both eyes";
  axis.choices = measure_lenses(stereo_choices(settings.quick), need, left, settings, progress);
  return axis;
}

}  // namespace ergodome
