#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <functional>

#include "content/show/reading/show_reader.h"
#include "content/sky/sky_map.h"
#include "kernels/launch/parallel_for.h"
#include "render/frame/show_renderer.h"
#include "render/lens/direct_lens.h"
#include "render/passes/stars/star_pass.h"

// Compares the full renderer with minimal frames, which run only the passes that a scene needs and
// have no code for effects. Both are timed in turn. In scenes without effects, the median ratio of
// their times should be 1.00 within noise; in other scenes, it is the cost of the effect.
namespace {

using namespace ergodome;

constexpr int size_px = 512;

constexpr const char* sky_scene =
    "[hole]\nspin = 0.999\n[camera]\n[[camera.key]]\nt_s = 0\nr = 5\n[[camera.key]]\nt_s = 1\nr = 5\nphi_deg = 5\n"
    "[sky]\nmap = \"milky_way\"\n";
constexpr const char* star_scene =
    "[hole]\nspin = 0.999\n[camera]\n[[camera.key]]\nt_s = 0\nr = 5\n[[camera.key]]\nt_s = 1\nr = 5\nphi_deg = 5\n"
    "[sky]\nmap = \"milky_way\"\nstars = \"bright_stars\"\n";

double seconds_of(const std::function<void()>& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

//! A minimal renderer: runs only the passes that a scene without effects needs.
class MinimalFrame {
 public:
  explicit MinimalFrame(const Show& show)
      : show_(show),
        projection_(make_projection(show.view, size_px, 0.0)),
        sky_(Backend::cpu, load_sky_map(show), sky_from_map(show.sky)),
        lens_(Backend::cpu, 11UL * size_px * size_px, "benchmark"),
        rgba_(Backend::cpu, 4UL * size_px * size_px, "benchmark") {
    if (!show.sky.stars.empty()) {
      stars_ = std::make_unique<StarPass>(show);
    }
  }

  void render() {
    const EyeCamera eye = eye_camera(show_, camera_pose(show_, 0.5), 0.0);
    const DirectLens source(Backend::cpu, eye, projection_, 0.2 * show_.quality.budget_px);
    LensPixels pixels{};
    float* next = lens_.data();
    const auto take = [&] { return std::exchange(next, next + static_cast<long>(size_px) * size_px); };
    pixels.coverage = take();
    pixels.error_estimate = take();
    for (int i = 0; i < 3; ++i) {
      pixels.sky[i] = take();
      pixels.sky_along_x[i] = take();
      pixels.sky_along_y[i] = take();
    }
    source.fill(0, size_px, pixels);
    ShadeBatch shade{};
    shade.lens = pixels;
    shade.sky = sky_.view();
    shade.projection = converted_projection<float>(projection_);
    shade.exposure = static_cast<float>(show_.sky.exposure);
    shade.rgba = rgba_.data();
    shade.count = size_px * size_px;
    launch(Backend::cpu, shade);
    std::vector<float> picture(rgba_.size());
    rgba_.read(picture.data(), picture.size());
    if (stars_) {
      stars_->draw(stars_->find(eye, projection_, {}), projection_, 0, size_px, picture.data());
    }
    // Counts failed rays, because the full renderer does this for every picture, too.
    benchmark::DoNotOptimize(
        std::count_if(pixels.error_estimate, pixels.error_estimate + shade.count, [](float e) { return e < 0.0F; }));
    benchmark::DoNotOptimize(picture.data());
  }

 private:
  Show show_;
  Projection projection_;
  SkyCube sky_;
  Buffer<float> lens_;
  Buffer<float> rgba_;
  std::unique_ptr<StarPass> stars_;
};

//! Measures frames of a scene with `added` appended to its TOML text. Reports their time relative
//! to the minimal frames of the scene without `added`.
void effect_cost(benchmark::State& state, const char* scene, const char* added) {
  const Show plain = parse_show(scene, "scene.toml");
  const Show show = parse_show(std::string(scene) + added, "scene.toml");
  MinimalFrame minimal(plain);
  ShowRenderer renderer(show, Backend::cpu, LensChoice::direct);
  const ViewChoice choice = {ViewMode::sky, size_px};
  const auto whole = [&] { benchmark::DoNotOptimize(renderer.render(0.5, choice).front().picture.rgba.data()); };
  const auto minimum = [&] { minimal.render(); };
  whole();
  minimum();
  std::vector<double> ratios;
  bool turn = false;
  for (auto _ : state) {
    turn = !turn;
    double of_least = turn ? seconds_of(minimum) : 0.0;
    const double of_whole = seconds_of(whole);
    of_least = turn ? of_least : seconds_of(minimum);
    ratios.push_back(of_whole / of_least);
    state.SetIterationTime(of_whole);
  }
  std::nth_element(ratios.begin(), ratios.begin() + static_cast<long>(ratios.size() / 2), ratios.end());
  state.counters["over_minimal"] = ratios[ratios.size() / 2];
  state.SetLabel(std::to_string(thread_count()) + " threads");
}

void timed(benchmark::internal::Benchmark* benchmark) {
  benchmark->UseManualTime()->Unit(benchmark::kMillisecond)->Iterations(41);
}

// Benchmarks named `absent` name an effect that has no influence: it is off or has zero strength.
BENCHMARK_CAPTURE(effect_cost, sky_no_effect, sky_scene, "")->Apply(timed);
BENCHMARK_CAPTURE(effect_cost, sky_redshift_absent, sky_scene, "[effects]\nredshift = false\n")->Apply(timed);
BENCHMARK_CAPTURE(effect_cost, sky_bloom_absent, sky_scene, "[effects]\nbloom = { strength = 0 }\n")->Apply(timed);
BENCHMARK_CAPTURE(effect_cost, sky_tone_absent, sky_scene, "[tone]\nexposure_stops = 0\n")->Apply(timed);
BENCHMARK_CAPTURE(effect_cost, stars_no_effect, star_scene, "")->Apply(timed);
BENCHMARK_CAPTURE(effect_cost, stars_magnification_absent, star_scene, "[effects]\nmagnification = false\n")
    ->Apply(timed);
BENCHMARK_CAPTURE(effect_cost, stars_trails_absent, star_scene, "[effects]\ntrails = { shutter_s = 0 }\n")
    ->Apply(timed);
BENCHMARK_CAPTURE(effect_cost, stars_diffraction_absent, star_scene, "[effects]\ndiffraction = { strength = 0 }\n")
    ->Apply(timed);
BENCHMARK_CAPTURE(effect_cost, sky_redshift, sky_scene, "[effects]\nredshift = true\n")->Apply(timed);
BENCHMARK_CAPTURE(effect_cost, sky_bloom, sky_scene, "[effects]\nbloom = { strength = 0.04 }\n")->Apply(timed);
BENCHMARK_CAPTURE(effect_cost, sky_automatic_exposure, sky_scene, "[tone]\nauto = { adapt_s = 1 }\n")->Apply(timed);
BENCHMARK_CAPTURE(effect_cost, stars_redshift, star_scene, "[effects]\nredshift = true\n")->Apply(timed);
BENCHMARK_CAPTURE(effect_cost, stars_magnification, star_scene, "[effects]\nmagnification = true\n")->Apply(timed);
BENCHMARK_CAPTURE(effect_cost, stars_psf, star_scene, "[effects]\npsf = { sigma_px = 0.5 }\n")->Apply(timed);
BENCHMARK_CAPTURE(effect_cost, stars_trails, star_scene, "[effects]\ntrails = { shutter_s = 0.3 }\n")->Apply(timed);
BENCHMARK_CAPTURE(effect_cost, stars_diffraction, star_scene, "[effects]\ndiffraction = {}\n")->Apply(timed);
BENCHMARK_CAPTURE(effect_cost, stars_gathered, star_scene, "[stars]\nmethod = \"gather\"\n")->Apply(timed);

}  // namespace
