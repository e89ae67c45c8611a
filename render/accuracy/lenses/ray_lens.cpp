#include <fmt/format.h>

#include <algorithm>

#include "kernels/launch/launch.h"
#include "render/accuracy/lenses/pixel_lens.h"
#include "render/published/quadtree_builder.h"

namespace ergodome {

namespace {

constexpr int ray_step_limit = 2000;
//! Maximum number of steps for the published tracer: ten times its own limit.
constexpr int baseline_step_limit = 20'000;

template <class S>
std::optional<Vector3<double>> sky_of(const RayPicture<S>& rays, std::int64_t pixel) {
  const auto found = std::lower_bound(rays.pixels.begin(), rays.pixels.end(), pixel);
  const auto at = static_cast<std::size_t>(found - rays.pixels.begin());
  if (found == rays.pixels.end() || *found != pixel || rays.status[at] != S(0)) {
    return std::nullopt;
  }
  return Vector3<double>{static_cast<double>(rays.sky[0][at]), static_cast<double>(rays.sky[1][at]),
                         static_cast<double>(rays.sky[2][at])};
}

template <class S>
RayBatch<S> batch_of(LensScene& scene) {
  RayPicture<S>& rays = scene.rays<S>();
  const EyeCamera& eye = scene.eye();
  RayBatch<S> batch{};
  batch.camera =
      converted_station<S>(make_camera_station(eye.spacetime, eye.r, eye.theta, eye.phi, eye.motion, eye.velocity));
  batch.count = static_cast<int>(rays.pixels.size());
  for (int k = 0; k < 3; ++k) {
    batch.direction[k] = rays.n[k].data();
    batch.sky[k] = rays.sky[k].data();
  }
  batch.status = rays.status.data();
  return batch;
}

//! Measures the method that traces one ray per pixel, with any integrator.
template <class S>
class RayLens : public PixelLens {
 public:
  RayLens(LensScene& scene, TraceMethod method, double tolerance) : rays_(scene.rays<S>()), batch_(batch_of<S>(scene)) {
    batch_.method = method;
    batch_.settings = {tolerance, method == TraceMethod::baseline_rk34 ? baseline_step_limit : ray_step_limit, true};
  }

  void draw() override { launch(Backend::cpu, batch_); }
  [[nodiscard]] std::optional<Vector3<double>> sky(std::int64_t pixel) const override { return sky_of(rays_, pixel); }

 private:
  const RayPicture<S>& rays_;
  RayBatch<S> batch_;
};

//! Measures the quadtree grid of Verbraeck & Eisemann (2021), built for the eye's position and
//! velocity and read once per pixel.
class QuadtreePixels : public PixelLens {
 public:
  QuadtreePixels(LensScene& scene, int finest_level, QuadtreeInterpolation how)
      : rays_(scene.rays<double>()), grid_(make_grid(scene.eye(), finest_level)) {
    batch_ = {batch_of<double>(scene), look_up_of(grid_.view(), how)};
  }

  void draw() override { launch(Backend::cpu, batch_); }
  [[nodiscard]] std::optional<Vector3<double>> sky(std::int64_t pixel) const override { return sky_of(rays_, pixel); }
  [[nodiscard]] std::size_t bytes() const override {
    return (static_cast<std::size_t>(grid_.view().mask) + 1) * sizeof(QuadtreeVertex);
  }

 private:
  static QuadtreeLens make_grid(const EyeCamera& eye, int finest_level) {
    QuadtreeSettings settings;
    settings.finest_level = finest_level;
    settings.coarsest_level = std::min(settings.coarsest_level, finest_level);
    return {make_camera_station(eye.spacetime, eye.r, eye.theta, 0.0, eye.motion, eye.velocity),
            quadtree_is_mirrored(eye.theta, eye.velocity), settings};
  }

  const RayPicture<double>& rays_;
  QuadtreeLens grid_;
  QuadtreeRaysBatch batch_{};
};

}  // namespace

LensChoiceToMeasure ray_choice(TraceMethod method, bool narrow, double tolerance) {
  constexpr const char* names[] = {"taylor", "rk34", "cash_karp", "closed_form", "baseline_rk34"};
  LensChoiceToMeasure choice;
  choice.method = names[static_cast<int>(method)];
  choice.setting = method == TraceMethod::closed_form ? "exact" : fmt::format("tolerance {:.0e}", tolerance);
  choice.precision = narrow ? "float" : "double";
  constexpr const char* published[] = {"", "RK34", "MSW, VE", "", "RK34"};
  choice.published = published[static_cast<int>(method)];
  choice.make = [=](LensScene& scene) -> std::unique_ptr<PixelLens> {
    if (narrow) {
      return std::make_unique<RayLens<float>>(scene, method, tolerance);
    }
    return std::make_unique<RayLens<double>>(scene, method, tolerance);
  };
  return choice;
}

LensChoiceToMeasure quadtree_choice(int finest_level, bool spline) {
  return {spline ? "quadtree, spline" : "quadtree, linear", fmt::format("level {}", finest_level), "float", "VE",
          [=](LensScene& scene) {
            return std::make_unique<QuadtreePixels>(
                scene, finest_level, spline ? QuadtreeInterpolation::spline : QuadtreeInterpolation::linear);
          }};
}

}  // namespace ergodome
