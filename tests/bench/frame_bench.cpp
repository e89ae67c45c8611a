#include <benchmark/benchmark.h>

#include "content/show_reader.h"
#include "kernels/launch/parallel_for.h"
#include "render/frame/show_renderer.h"

// Whole frames of the direct lens: a ray a pixel with its footprint, the shadow's soft edge, and the filtered sky; memory to memory.
namespace {

using namespace ergodome;

Show dome_show() {
  return parse_show(
      "[hole]\nspin = 0.999\n[camera]\n[[camera.key]]\nr = 5\npitch_deg = -25\n[sky]\nmap = \"milky_way\"\n"
      "[view]\nprojection = \"dome\"\ntilt_deg = 30\n",
      "bench.toml");
}

void dome_frame(benchmark::State& state, ViewMode mode) {
  const int size = static_cast<int>(state.range(0));
  ShowRenderer renderer(dome_show(), Backend::cpu);
  const Projection projection = make_projection(renderer.show().view, size, 0.0);
  const CameraPose pose = camera_pose(renderer.show(), 0.0);
  for (auto _ : state) {
    benchmark::DoNotOptimize(renderer.render_eye(pose, 0.0, projection, mode).rgba.data());
  }
  state.counters["ns_per_pixel"] =
      benchmark::Counter(static_cast<double>(size) * size * 1e-9,
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  state.SetLabel(std::string(name_of(active_instruction_set())) + ", " + std::to_string(thread_count()) + " threads");
}

BENCHMARK_CAPTURE(dome_frame, sky, ViewMode::sky)
    ->Arg(512)
    ->Arg(1024)
    ->Arg(2048)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(dome_frame, image_order, ViewMode::image_order)
    ->Arg(1024)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

void edge_table(benchmark::State& state) {
  const CameraStation camera = make_camera_station(0.999, 5.0, 1.5707963, 0.0, ObserverMotion::zamo);
  for (auto _ : state) {
    benchmark::DoNotOptimize(EdgeTable(Backend::cpu, camera, 1024).view());
  }
}

BENCHMARK(edge_table)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
