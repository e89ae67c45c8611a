#include <benchmark/benchmark.h>

#include "content/show/reading/show_reader.h"
#include "kernels/launch/parallel_for.h"
#include "render/frame/show_renderer.h"
#include "render/lens/grid/edge_table.h"
#include "render/lens/grid/grid_builder.h"

// Times of rendering whole frames into memory: the lens with its footprints, the soft edge of the
// shadow and the filtered sky. The lens is traced (one ray per pixel), read from an existing grid
// (kept), or read from a grid that is built for each frame (live).
namespace {

using namespace ergodome;

//! Returns a dome show; `more` is appended to its text, starting inside the [sky] table.
Show dome_show(const std::string& more = {}) {
  return parse_show(
      "[hole]\nspin = 0.999\n[camera]\n[[camera.key]]\nr = 5\npitch_deg = -25\n"
      "[view]\nprojection = \"dome\"\ntilt_deg = 30\n[sky]\nmap = \"milky_way\"\n" +
          more,
      "bench.toml");
}

void dome_frame(benchmark::State& state, ViewMode mode, LensChoice lens, bool moving) {
  const int size = static_cast<int>(state.range(0));
  ShowRenderer renderer(dome_show(), Backend::cpu, lens);
  const Projection projection = make_projection(renderer.show().view, size, 0.0);
  CameraPose pose = camera_pose(renderer.show(), 0.0);
  for (auto _ : state) {
    pose.r += moving ? 1e-9 : 0.0;
    benchmark::DoNotOptimize(renderer.render_eye(pose, 0.0, projection, mode).rgba.data());
  }
  state.counters["ns_per_pixel"] =
      benchmark::Counter(static_cast<double>(size) * size * 1e-9,
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  state.SetLabel(std::string(name_of(active_instruction_set())) + ", " + std::to_string(thread_count()) + " threads");
}

void sizes(benchmark::internal::Benchmark* benchmark) {
  benchmark->Arg(512)->Arg(1024)->Arg(2048)->Unit(benchmark::kMillisecond)->UseRealTime();
}

BENCHMARK_CAPTURE(dome_frame, direct, ViewMode::sky, LensChoice::direct, false)->Apply(sizes);
BENCHMARK_CAPTURE(dome_frame, kept_grid, ViewMode::sky, LensChoice::live, false)->Apply(sizes);
BENCHMARK_CAPTURE(dome_frame, live_grid, ViewMode::sky, LensChoice::live, true)->Apply(sizes);
BENCHMARK_CAPTURE(dome_frame, image_order, ViewMode::image_order, LensChoice::direct, false)
    ->Arg(1024)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

//! Measures domes with the camera of the show once-around, which moves on by one frame each time, so
//! that each frame needs a new grid. Without stars; in processor time of all threads. The argument
//! is the show time at which the frames start [s].
void once_around(benchmark::State& state) {
  const char* const text =
      "duration_s = 100\n[hole]\nspin = 0.0\n[camera]\nobserver = \"zamo\"\n"
      "[[camera.key]]\nt_s = 0\nr = 60\ntheta_deg = 85\nphi_deg = 0\npitch_deg = -25\n"
      "[[camera.key]]\nt_s = 12\nr = 40\ntheta_deg = 85\nphi_deg = 4\npitch_deg = -25\n"
      "[[camera.key]]\nt_s = 30\nr = 12\ntheta_deg = 86\nphi_deg = 30\npitch_deg = -25\n"
      "[[camera.key]]\nt_s = 38\nr = 12\ntheta_deg = 86\nphi_deg = 50\npitch_deg = -25\n"
      "[[camera.key]]\nt_s = 68\nr = 10\ntheta_deg = 88\nphi_deg = 390\npitch_deg = -25\n"
      "[[camera.key]]\nt_s = 76\nr = 8\ntheta_deg = 90\nphi_deg = 410\npitch_deg = -25\n"
      "[[camera.key]]\nt_s = 92\nr = 8\ntheta_deg = 90\nphi_deg = 440\npitch_deg = -25\n"
      "[[camera.key]]\nt_s = 100\nr = 14\ntheta_deg = 88\nphi_deg = 450\npitch_deg = -25\n"
      "[sky]\nmap = \"milky_way\"\n[view]\nprojection = \"dome\"\nfov_deg = 180\ntilt_deg = 30\n"
      "[[animate]]\nnumber = \"hole.spin\"\nkey = [{ t_s = 74, value = 0.0, ease = \"in_out\" }, { t_s = 88, value = "
      "0.999 }]\n";
  ShowRenderer renderer(parse_show(text, "once-around.toml"), Backend::cpu);
  const Projection projection = make_projection(renderer.show().view, 1024, 0.0);
  int frame = static_cast<int>(state.range(0)) * 30;
  for (auto _ : state) {
    const double time_s = ++frame / 30.0;
    renderer.apply(time_s);
    const CameraPose pose = camera_pose(renderer.show(), time_s);
    benchmark::DoNotOptimize(renderer.render_eye(pose, 0.0, projection, ViewMode::sky).rgba.data());
  }
  state.SetLabel(std::string(name_of(active_instruction_set())) + ", " + std::to_string(thread_count()) + " threads");
}

BENCHMARK(once_around)->Arg(20)->Arg(50)->DenseRange(5, 95, 10)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();

//! Measures frames with other settings of the sky filter; `more` contains lines of the [sky] table.
//! The lens is read from an existing grid.
void sky_look(benchmark::State& state, const char* more) {
  ShowRenderer renderer(dome_show(more), Backend::cpu, LensChoice::live);
  const Projection projection = make_projection(renderer.show().view, 1024, 0.0);
  const CameraPose pose = camera_pose(renderer.show(), 0.0);
  for (auto _ : state) {
    benchmark::DoNotOptimize(renderer.render_eye(pose, 0.0, projection, ViewMode::sky).rgba.data());
  }
}

void in_milliseconds(benchmark::internal::Benchmark* benchmark) {
  benchmark->Unit(benchmark::kMillisecond)->UseRealTime();
}

BENCHMARK_CAPTURE(sky_look, ewa, "")->Apply(in_milliseconds);
BENCHMARK_CAPTURE(sky_look, point, "filter = \"point\"\n")->Apply(in_milliseconds);
BENCHMARK_CAPTURE(sky_look, polygon, "filter = \"polygon\"\n")->Apply(in_milliseconds);
BENCHMARK_CAPTURE(sky_look, ewa_luminance, "[effects]\nredshift = true\n")->Apply(in_milliseconds);
BENCHMARK_CAPTURE(sky_look, ewa_blackbody_fit, "shift = \"blackbody_fit\"\n[effects]\nredshift = true\n")
    ->Apply(in_milliseconds);
BENCHMARK_CAPTURE(sky_look, ewa_brightening, "brightening = true\n")->Apply(in_milliseconds);

//! Builds a lens grid for the camera of these benchmarks. The argument is the error budget, in
//! hundredths of a pixel of a 4096² dome. Rays are traced in float or, if `fine`, in double.
void grid_build(benchmark::State& state, bool fine) {
  GridSettings settings;
  settings.budget_px = 0.01 * static_cast<double>(state.range(0));
  settings.fine = fine;
  settings.observer = aberration_to_rain(Spacetime{0.999}, 5.0, 0.5 * 3.14159265358979323846, ObserverMotion::zamo, {});
  GridStatistics statistics;
  for (auto _ : state) {
    const LensStation station =
        build_lens_station(Spacetime{0.999}, 5.0, 0.5 * 3.14159265358979323846, settings, &statistics);
    benchmark::DoNotOptimize(station.nodes.data());
  }
  state.counters["nodes"] = statistics.nodes;
  state.counters["checks"] = static_cast<double>(statistics.traced_checks);
  state.counters["flagged_px"] = statistics.flagged_px;
}

BENCHMARK_CAPTURE(grid_build, float, false)->Arg(10)->Arg(25)->Arg(100)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(grid_build, double, true)->Arg(1)->Arg(10)->Arg(25)->Unit(benchmark::kMillisecond)->UseRealTime();

void edge_table(benchmark::State& state) {
  const CameraStation camera = make_camera_station(Spacetime{0.999}, 5.0, 1.5707963, 0.0, ObserverMotion::zamo);
  for (auto _ : state) {
    benchmark::DoNotOptimize(EdgeTable(Backend::cpu, camera, 1024).view());
  }
}

BENCHMARK(edge_table)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
