#include <benchmark/benchmark.h>

#include <cmath>

#include "kernels/launch/parallel_for.h"
#include "render/lens/grid_builder.h"
#include "render/stars/star_pass.h"

// Finding and drawing the images of stars on a 1024² dome, down to a magnitude: the grid and its turning round, as each new place of the
// camera needs them, apart from what each picture needs.
namespace {

using namespace ergodome;

constexpr double pi = 3.14159265358979323846;
constexpr double pixel = pi / 1024;

EyeCamera eye() {
  EyeCamera eye{0.999, 5.0, 0.5 * pi, 0.7, ObserverMotion::geodesic, {}, {}, 5.0, 0.5 * pi};
  const double at_hole[3][3] = {{0, 0, 1}, {0, -1, 0}, {1, 0, 0}};
  std::copy(&at_hole[0][0], &at_hole[0][0] + 9, &eye.frame_from_view[0][0]);
  return eye;
}

StarField field_of(long stars, const BlackbodyColours& colours) {
  Show show;
  show.sky.stars = "all_stars";
  StarCatalogue catalogue = load_stars(show);
  catalogue.stars.resize(static_cast<std::size_t>(stars));
  return {catalogue, glm::dmat3(1.0), colours.view()};
}

StarSettings settings_to(double faintest_mag) {
  StarSettings settings;
  settings.pixel = pixel;
  settings.faintest = static_cast<float>(illuminance_of_magnitude_0 * std::pow(10.0, -0.4 * faintest_mag));
  return settings;
}

LensStation station_for(const EyeCamera& eye) {
  GridSettings grid;
  grid.pixel = pixel;
  grid.budget_px = 1.0;
  grid.least_area_px = 4.0;
  grid.fine = false;
  grid.observer = aberration_to_rain(eye.spin, eye.r, eye.theta, eye.motion, eye.velocity);
  return build_lens_station(eye.spin, eye.r, eye.theta, grid);
}

void star_place(benchmark::State& state) {
  const BlackbodyColours colours(Backend::cpu);
  const StarField field = field_of(state.range(0), colours);
  const StarSettings settings = settings_to(10.0);
  for (auto _ : state) {
    const LensStation station = station_for(eye());
    benchmark::DoNotOptimize(star_patches(field, colours.view(), eye(), station, settings).patches().data());
  }
}

void star_picture(benchmark::State& state) {
  const BlackbodyColours colours(Backend::cpu);
  const StarField field = field_of(state.range(0), colours);
  const StarSettings settings = settings_to(10.0);
  const LensStation station = station_for(eye());
  const StarPatches patches = star_patches(field, colours.view(), eye(), station, settings);
  const Projection projection = make_dome_projection(1024, pi, 0.5);
  std::vector<float> rgba(4UL * 1024 * 1024);
  std::size_t images = 0;
  for (auto _ : state) {
    const auto found = find_star_images(field, colours.view(), eye(), station, patches, settings);
    splat_stars(found, eye(), projection, {0.5, 1.0F}, 0, 1024, rgba.data());
    images = found.size();
  }
  state.counters["images"] = static_cast<double>(images);
  state.SetLabel(std::to_string(thread_count()) + " threads");
}

BENCHMARK(star_place)->Arg(5000)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(star_picture)->Arg(5000)->Arg(118'216)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
