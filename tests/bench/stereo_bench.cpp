#include <benchmark/benchmark.h>

#include "content/show_reader.h"
#include "kernels/launch/parallel_for.h"
#include "render/frame/show_renderer.h"

// Frames of both eyes beside those of one, memory to memory, with a camera that comes nearer all the time: nothing is kept from frame to frame.
namespace {

using namespace ergodome;

void stereo_frame(benchmark::State& state, const char* stereo) {
  const int size = static_cast<int>(state.range(0));
  const Show show =
      parse_show(std::string("[hole]\nspin = 0.999\n[camera]\n[[camera.key]]\nr = 8\npitch_deg = -25\n"
                             "[view]\nprojection = \"dome\"\ntilt_deg = 30\n[sky]\nmap = \"milky_way\"\n[stereo]\n") +
                     stereo,
                 "bench.toml");
  ShowRenderer renderer(show, Backend::cpu);
  const Projection projection = make_projection(show.view, size, 0.0);
  CameraPose pose = camera_pose(show, 0.0);
  for (auto _ : state) {
    pose.r -= 1e-6;
    benchmark::DoNotOptimize(renderer.render_window(pose, projection, ViewMode::sky).rgba.data());
  }
  state.SetLabel(std::string(name_of(active_instruction_set())) + ", " + std::to_string(thread_count()) + " threads");
}

void sizes(benchmark::internal::Benchmark* benchmark) {
  benchmark->Arg(1024)->Arg(2048)->Unit(benchmark::kMillisecond)->UseRealTime();
}

BENCHMARK_CAPTURE(stereo_frame, mono, "")->Apply(sizes);
BENCHMARK_CAPTURE(stereo_frame, physical, "layout = \"separate\"\nbaseline = 0.1\n")->Apply(sizes);
BENCHMARK_CAPTURE(stereo_frame, flat, "layout = \"separate\"\nbaseline = 0.1\nmodel = \"flat\"\n")->Apply(sizes);
BENCHMARK_CAPTURE(stereo_frame, omni, "layout = \"separate\"\nbaseline = 0.1\nmodel = \"omni\"\n")->Apply(sizes);

}  // namespace
