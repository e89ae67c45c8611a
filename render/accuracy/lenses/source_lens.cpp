#include "render/accuracy/lenses/source_lens.h"

#include <fmt/format.h>

#include "content/trajectory/station_codec.h"
#include "render/lens/direct_lens.h"
#include "render/lens/grid/grid_builder.h"
#include "render/lens/grid/grid_lens.h"
#include "render/lens/lens_source.h"
#include "render/lens/quadtree_source.h"

namespace ergodome {

namespace {

//! Error tolerance of the rays that a grid leaves to tracing, as a fraction of the grid's budget.
//! It is the same as in the renderer.
constexpr double ray_share = 0.2;

GridSettings grid_settings(const LensScene& scene, double budget_px) {
  const EyeCamera& eye = scene.eye();
  GridSettings settings;
  settings.pixel = scene.moment().pixel;
  settings.budget_px = budget_px;
  settings.observer = aberration_to_rain(eye.spacetime, eye.r, eye.theta, eye.motion, eye.velocity);
  settings.fine = budget_px * settings.pixel < finest_float_budget;
  return settings;
}

std::unique_ptr<PixelLens> make_grid(LensScene& scene, double budget_px) {
  const EyeCamera& eye = scene.eye();
  LensStation station = build_lens_station(eye.spacetime, eye.r, eye.theta, grid_settings(scene, budget_px));
  const auto packed = [station] { return pack_station(station).bytes.size(); };
  const auto buffers = std::make_shared<const StationBuffers>(Backend::cpu, std::move(station));
  return std::make_unique<SourcePixels>(scene,
                                        std::make_unique<GridLens>(Backend::cpu, "kept", StationBlend(buffers), eye,
                                                                   scene.projection(), ray_share * budget_px),
                                        buffers->bytes(), packed);
}

}  // namespace

LensChoiceToMeasure direct_choice(double tolerance_px) {
  return {"direct rays", fmt::format("tolerance {:g} px", tolerance_px), "float", "", [=](LensScene& scene) {
            return std::make_unique<SourcePixels>(
                scene, std::make_unique<DirectLens>(Backend::cpu, scene.eye(), scene.projection(), tolerance_px));
          }};
}

LensChoiceToMeasure grid_choice(double budget_px) {
  LensChoiceToMeasure choice;
  choice.method = "conforming grid";
  choice.setting = fmt::format("budget {:g} px", budget_px);
  choice.make = [=](LensScene& scene) { return make_grid(scene, budget_px); };
  return choice;
}

LensChoiceToMeasure quadtree_pixel_choice(int finest_level) {
  return {"quadtree, spline", fmt::format("level {}", finest_level), "float", "VE", [=](LensScene& scene) {
            const EyeCamera& eye = scene.eye();
            QuadtreeSettings settings;
            settings.finest_level = finest_level;
            const auto grid = std::make_shared<const QuadtreeLens>(
                make_camera_station(eye.spacetime, eye.r, eye.theta, 0.0, eye.motion, eye.velocity),
                quadtree_is_mirrored(eye.theta, eye.velocity), settings);
            return std::make_unique<SourcePixels>(
                scene, std::make_unique<QuadtreeSource>(grid, eye, scene.projection(), 1.0),
                (static_cast<std::size_t>(grid->view().mask) + 1) * sizeof(QuadtreeVertex));
          }};
}

}  // namespace ergodome
