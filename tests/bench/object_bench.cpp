#include <benchmark/benchmark.h>

#include <string>
#include <vector>

#include "content/camera/camera_path.h"
#include "content/show/reading/show_reader.h"
#include "content/sky/sky_map.h"
#include "render/eyes/view_projection.h"
#include "render/passes/objects/object_pass.h"
#include "render/passes/objects/traced_objects.h"
#include "tests/bench/cuda_bench.h"

// The image sequences of table 3 in Müller, Schulz & Weiskopf, from built-in shows of the same
// scenes: a triangle (300 frames), a sphere (360) and a disk (180), each at three widths. There is
// no sky, and no image files are written. Each iteration draws another one of 12 frames, which are
// spread evenly over the sequence; the result is the time per frame.
namespace {

using namespace ergodome;

//! Renders frames of a sequence by exact rays, including shadows.
void traced_frame(benchmark::State& state, const std::string& name, int frames, Backend backend = Backend::cpu) {
  constexpr int shown = 12;
  const Show show = read_show(built_in_content_folder() / "shows" / (name + ".toml"));
  TracedObjects objects(show, backend);
  const Projection projection = make_projection(show.view, static_cast<int>(state.range(0)), 0.0);
  int next = 0;
  for (auto _ : state) {
    const double time_s = show.duration_s * (next % shown) / shown;
    const EyeCamera eye = eye_camera(show, camera_pose(show, time_s), 0.0);
    benchmark::DoNotOptimize(
        objects.draw({eye, nullptr, projection, 0.2 * show.quality.budget_px, time_s}, {0, projection.height_px}));
    ++next;
  }
  state.counters["frames"] = frames;
  state.counters["triangles"] = static_cast<double>(objects.triangle_count());
}

void object_frame(benchmark::State& state, const std::string& name, int frames) {
  constexpr int shown = 12;
  const Show show = read_show(built_in_content_folder() / "shows" / (name + ".toml"));
  ObjectPass pass(show);
  const Projection projection = make_projection(show.view, static_cast<int>(state.range(0)), 0.0);
  std::vector<float> rgba(4 * static_cast<std::size_t>(projection.width_px) *
                          static_cast<std::size_t>(projection.height_px));
  int next = 0;
  for (auto _ : state) {
    const double time_s = show.duration_s * (next % shown) / shown;
    pass.draw(eye_camera(show, camera_pose(show, time_s), 0.0), projection, time_s, rgba.data());
    benchmark::DoNotOptimize(rgba.data());
    ++next;
  }
  state.counters["frames"] = frames;
  state.counters["triangles"] = static_cast<double>(pass.triangle_count());
}

//! Runs a benchmark at the widths Least, 2 Least and 4 Least [px].
template <int Least>
void from_width(benchmark::internal::Benchmark* frames) {
  frames->Arg(Least)->Arg(2 * Least)->Arg(4 * Least)->Iterations(12)->Unit(benchmark::kMillisecond)->UseRealTime();
}

BENCHMARK_CAPTURE(object_frame, triangle, "triangle", 300)->Apply(from_width<640>);
BENCHMARK_CAPTURE(object_frame, sphere, "sphere", 360)->Apply(from_width<512>);
BENCHMARK_CAPTURE(object_frame, disk, "thick-disk", 180)->Apply(from_width<400>);
BENCHMARK_CAPTURE(traced_frame, triangle, "triangle", 300)->Apply(from_width<640>);
BENCHMARK_CAPTURE(traced_frame, sphere, "sphere", 360)->Apply(from_width<512>);
BENCHMARK_CAPTURE(traced_frame, disk, "thick-disk", 180)->Apply(from_width<400>);

}  // namespace

void ergodome::add_cuda_object_benchmarks() {
  const auto add = [](const char* name, int frames, int width) {
    auto* const made = benchmark::RegisterBenchmark(
        (std::string("cuda_traced_frame/") + name).c_str(),
        [name, frames](benchmark::State& state) { traced_frame(state, name, frames, Backend::cuda); });
    made->Unit(benchmark::kMillisecond)->UseRealTime()->Iterations(12);
    for (const int size : {width, 2 * width, 4 * width}) {
      made->Arg(size);
    }
  };
  add("triangle", 300, 640);
  add("sphere", 360, 512);
  add("thick-disk", 180, 400);
}
