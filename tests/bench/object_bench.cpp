#include <benchmark/benchmark.h>

#include <string>
#include <vector>

#include "content/camera_path.h"
#include "content/show_reader.h"
#include "content/sky_map.h"
#include "render/frame/view_projection.h"
#include "render/objects/object_pass.h"

// The sequences of Müller, Schulz & Weiskopf's table 3 by the built-in shows of their scenes: a triangle (300 frames), a sphere (360) and a disk
// (180), each at three widths, without sky and without image files. A run draws the next of frames spread evenly over the sequence; its time is
// that of one frame.
namespace {

using namespace ergodome;

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

BENCHMARK_CAPTURE(object_frame, triangle, "triangle", 300)
    ->Arg(640)
    ->Arg(1280)
    ->Arg(2560)
    ->Iterations(12)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(object_frame, sphere, "sphere", 360)
    ->Arg(512)
    ->Arg(1024)
    ->Arg(2048)
    ->Iterations(12)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(object_frame, disk, "thick-disk", 180)
    ->Arg(400)
    ->Arg(800)
    ->Arg(1600)
    ->Iterations(12)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
