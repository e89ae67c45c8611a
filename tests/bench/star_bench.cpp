#include <benchmark/benchmark.h>

#include <cmath>

#include "kernels/core/angles.h"
#include "kernels/launch/parallel_for.h"
#include "kernels/projection/make_projection.h"
#include "render/passes/stars/star_pass.h"

// Times of finding and drawing the lensed images of stars on a 1024² dome, down to a given
// magnitude. The work for each new camera position (building the grid and searching it for stars)
// is measured separately from the work for each picture.
namespace {

using namespace ergodome;

constexpr double pixel = pi / 1024;

EyeCamera eye() {
  EyeCamera eye{Spacetime{0.999}, 5.0, 0.5 * pi, 0.7, ObserverMotion::geodesic, {}, {}, 5.0, 0.5 * pi};
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

StarSettings settings_to(double faintest_mag, long thousandths_of_px = 250) {
  StarSettings settings;
  settings.pixel = pixel;
  settings.faintest = static_cast<float>(illuminance_of_magnitude_0 * std::pow(10.0, -0.4 * faintest_mag));
  settings.min_cell_px = min_star_cell_px(1e-3 * static_cast<double>(thousandths_of_px));
  return settings;
}

//! Measures the work for a new camera position. The arguments are the number of stars and the lens
//! budget of the show [1e-3 px]. Reuses the memory of the previous position, as in a show with a
//! moving camera.
void star_place(benchmark::State& state) {
  const BlackbodyColours colours(Backend::cpu);
  const StarField field = field_of(state.range(0), colours);
  const StarSettings settings = settings_to(10.0, state.range(1));
  PatchRoom room;
  for (auto _ : state) {
    const LensStation station = build_star_station(eye(), settings);
    StarPatches patches = star_patches(field, colours.view(), eye(), station, settings, room);
    benchmark::DoNotOptimize(patches.patches().data());
    room.patches = std::move(patches).given_up();
  }
}

//! Measures the work for a picture: finding and drawing star images in patches that exist. The
//! arguments are the number of stars, the width of the picture and the lens budget [1e-3 px].
void star_picture(benchmark::State& state) {
  const BlackbodyColours colours(Backend::cpu);
  const StarField field = field_of(state.range(0), colours);
  StarSettings settings = settings_to(10.0, state.range(2));
  const LensStation station = build_star_station(eye(), settings);
  const StarPatches patches = star_patches(field, colours.view(), eye(), station, settings);
  const int width = static_cast<int>(state.range(1));
  const Projection projection = make_dome_projection(width, pi, 0.5);
  settings.view = view_cone(eye(), projection, 0.06);
  std::vector<float> rgba(4UL * static_cast<std::size_t>(width) * static_cast<std::size_t>(width));
  std::size_t images = 0;
  for (auto _ : state) {
    const auto found = find_star_images(field, colours.view(), eye(), station, patches, settings);
    splat_points(star_points(found, eye(), projection, {0.5, 1.0F}), projection, {0.5, 1.0F}, 0, width, rgba.data());
    images = found.size();
  }
  state.counters["images"] = static_cast<double>(images);
  state.SetLabel(std::to_string(thread_count()) + " threads");
}

//! Finds the same stars by the published method: each pixel gathers the stars that it covers on the
//! sky.
void star_gathered_picture(benchmark::State& state) {
  const BlackbodyColours colours(Backend::cpu);
  const StarField field = field_of(state.range(0), colours);
  const StarTree tree(field);
  const StarSettings settings = settings_to(10.0);
  const Projection projection = make_dome_projection(static_cast<int>(state.range(1)), pi, 0.5);
  std::size_t images = 0;
  for (auto _ : state) {
    images = gather_stars(field, tree, colours.view(), eye(), projection, settings).stars.size();
  }
  state.counters["images"] = static_cast<double>(images);
}

//! How the camera changes from picture to picture. `goes_round_in_sizes`: it goes around the hole
//! while the width of the picture changes. `approaches`: it also moves toward the hole and changes
//! its latitude, so that
//! each picture is from a new position.
enum class Way { turns, goes_round, goes_round_in_sizes, approaches };

//! Draws the stars of consecutive pictures of a window. `way`: the camera turns by two degrees per
//! picture, goes around the hole, or goes around it while the picture's width changes (as when the
//! player adapts it to the available time). `match`: whether star images that were found for pixels
//! of about the same size are reused, or only those for exactly this size.
void star_pictures(benchmark::State& state, Way way, PixelMatch match, bool slow = false) {
  Show show;
  show.sky.stars = state.range(0) > 10'000 ? "all_stars" : "bright_stars";
  show.sky.faintest_mag = 10.0;
  StarPass pass(show);
  EyeCamera camera = eye();
  std::vector<float> rgba(4UL * 1100UL * 1100UL);
  int picture = 0;
  const auto show_next = [&] {
    const int width = way == Way::goes_round_in_sizes ? 1000 + 7 * (picture % 7) : 1024;
    const Projection projection = make_dome_projection(width, pi, 0.5);
    camera.phi += way == Way::turns ? 0.0 : 1e-3;
    CameraCourse course{slow};
    if (way == Way::approaches) {
      const LensPosition before = {camera.r, camera.theta};
      camera.r = camera.head_r = 5.0 * std::exp(-2e-4 * picture);
      camera.theta = camera.head_theta = 1.5 + 4e-5 * picture;
      camera.motion = ObserverMotion::zamo;
      course.step = {camera.r - before.r, camera.theta - before.theta};
    }
    const double turn = way == Way::turns ? 2.0 * one_degree * picture : 0.0;
    const double at_hole[3][3] = {
        {std::sin(turn), 0, std::cos(turn)}, {0, -1, 0}, {std::cos(turn), 0, -std::sin(turn)}};
    std::copy(&at_hole[0][0], &at_hole[0][0] + 9, &camera.frame_from_view[0][0]);
    pass.draw(pass.find(camera, projection, {}, match, course), projection, 0, width, rgba.data());
    ++picture;
  };
  while (picture < 8) {
    show_next();
  }
  for (auto _ : state) {
    show_next();
  }
}

//! Runs a benchmark with 8,874 bright stars and with all 118,216 stars.
void of_both_catalogues(benchmark::internal::Benchmark* benchmark) {
  benchmark->Arg(8874)->Arg(118'216)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();
}

BENCHMARK_CAPTURE(star_pictures, turns, Way::turns, PixelMatch::about)->Apply(of_both_catalogues);
BENCHMARK_CAPTURE(star_pictures, goes_round, Way::goes_round, PixelMatch::about)->Apply(of_both_catalogues);
BENCHMARK_CAPTURE(star_pictures, goes_round_in_sizes, Way::goes_round_in_sizes, PixelMatch::about)
    ->Apply(of_both_catalogues);
BENCHMARK_CAPTURE(star_pictures, goes_round_in_sizes_of_their_own, Way::goes_round_in_sizes, PixelMatch::exact)
    ->Apply(of_both_catalogues);
// The camera enters a new cell of star patches about every 75 pictures.
BENCHMARK_CAPTURE(star_pictures, approaches, Way::approaches, PixelMatch::exact, true)
    ->Apply(of_both_catalogues)
    ->Iterations(400);
BENCHMARK_CAPTURE(star_pictures, approaches_with_own_grids, Way::approaches, PixelMatch::exact, false)
    ->Apply(of_both_catalogues);
BENCHMARK(star_place)
    ->Args({5000, 250})
    ->Args({118216, 250})
    ->Args({5000, 62})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(star_picture)
    ->Args({5000, 1024, 250})
    ->Args({20'000, 1024, 250})
    ->Args({118'216, 1024, 250})
    ->Args({118'216, 4096, 250})
    ->Args({5000, 1024, 62})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(star_gathered_picture)
    ->Args({5000, 1024})
    ->Args({118'216, 1024})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
