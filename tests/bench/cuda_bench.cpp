#include "tests/bench/cuda_bench.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <glm/gtc/quaternion.hpp>
#include <map>
#include <string>

#include "content/show/reading/show_reader.h"
#include "content/sky/sky_map.h"
#include "kernels/core/angles.h"
#include "kernels/launch/launch.h"
#include "kernels/launch/work_counter.h"
#include "render/frame/show_renderer.h"
#include "tests/bench/published_sky.h"

// Times of whole frames that a window would show: the GPU renders them and keeps them. Registers no
// benchmarks without a GPU.
namespace {

using namespace ergodome;

//! How the camera moves from frame to frame. `stands`: not at all. `turns`: turns by two degrees,
//! so that the same stars appear at other pixels. `goes_round`: moves around the hole by a tiny
//! angle, which requires a new star search. `moves`: moves to another radius, which requires a new
//! lens.
enum class CameraWay { stands, turns, goes_round, moves };

//! The source of the lens and the motion of the camera in a benchmark.
struct FrameWay {
  LensChoice lens;
  CameraWay camera;
};

Show built_in(const char* name) {
  return read_show(built_in_content_folder() / "shows" / (std::string(name) + ".toml"));
}

//! Lists the kinds of work that take the CPU more than 0.05 ms per picture. The GPU works
//! asynchronously and in order, and the CPU waits for it only where it reads results; therefore
//! times of GPU work are not listed. The star search runs at the same time as GPU work.
std::string times_of(const std::map<std::string, WorkCount>& work, long pictures) {
  std::string words;
  for (const auto& [name, count] : work) {
    const double time_ms = 1e-6 * static_cast<double>(count.time_ns) / static_cast<double>(pictures);
    if (time_ms > 0.05) {
      words += fmt::format("; {} {:.2f} ms", name, time_ms);
    }
  }
  return words;
}

void cuda_frame(benchmark::State& state, const Show& show, const FrameWay& way) {
  const int size = static_cast<int>(state.range(0));
  ShowRenderer renderer(show, Backend::cuda, way.lens);
  const double time_s = 0.31 * show.duration_s;
  renderer.apply(time_s);
  const Projection projection = make_projection(renderer.show().view, size, 0.0);
  CameraPose pose = camera_pose(renderer.show(), time_s);
  const char* lens = renderer.render_eyes_in_place(pose, projection, ViewMode::sky, {time_s}).first.lens;
  const auto before = work_done();
  for (auto _ : state) {
    pose.r += way.camera == CameraWay::moves ? 1e-9 : 0.0;
    pose.phi += way.camera == CameraWay::goes_round ? 1e-9 : 0.0;
    if (way.camera == CameraWay::turns) {
      pose.orientation = glm::normalize(pose.orientation * glm::angleAxis(2.0 * one_degree, glm::dvec3(0.0, 1.0, 0.0)));
    }
    benchmark::DoNotOptimize(renderer.render_eyes_in_place(pose, projection, ViewMode::sky, {time_s}));
  }
  state.SetLabel(std::string(lens) + times_of(work_between(before, work_done()), state.iterations()));
}

//! Measures frames that the GPU renders and copies back to the CPU.
void cuda_picture(benchmark::State& state, const Show& show) {
  const int size = static_cast<int>(state.range(0));
  ShowRenderer renderer(show, Backend::cuda, LensChoice::automatic);
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        renderer.render(0.31 * show.duration_s, {ViewMode::sky, size}).front().picture.rgba.data());
  }
}

//! Returns a dome show 5 M from a fast-spinning hole.
Show dome(const std::string& sky, const std::string& effects = {}) {
  return parse_show(
      "[hole]\nspin = 0.999\n[camera]\nobserver = \"geodesic\"\n[[camera.key]]\nr = 5\npitch_deg = -25\n[view]\n"
      "projection = \"dome\"\ntilt_deg = 30\n[sky]\nmap = \"milky_way\"\n" +
          sky + "[effects]\n" + effects,
      "bench.toml");
}

//! Returns the dome show in stereo, with both eyes side by side.
Show two_eyes() {
  Show show = dome("");
  show.stereo.layout = StereoLayout::side_by_side;
  show.stereo.baseline = 0.1;
  return show;
}

void add(const std::string& name, const Show& show, const FrameWay& way, std::initializer_list<int> sizes) {
  auto* const made = benchmark::RegisterBenchmark(
      ("cuda_frame/" + name).c_str(), [show, way](benchmark::State& state) { cuda_frame(state, show, way); });
  made->Unit(benchmark::kMillisecond)->UseRealTime();
  for (const int size : sizes) {
    made->Arg(size);
  }
}

void add_picture(const std::string& name, const Show& show, int size) {
  benchmark::RegisterBenchmark(("cuda_picture/" + name).c_str(),
                               [show](benchmark::State& state) { cuda_picture(state, show); })
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime()
      ->Arg(size);
}

const char* const every_effect =
    "redshift = true\nmagnification = true\npsf = { sigma_px = 0.5 }\ndiffraction = { brighter_than_mag = 2.0 }\n";

}  // namespace

void ergodome::add_cuda_benchmarks() {
  if (cuda_unavailable_reason() != nullptr) {
    return;
  }
  const FrameWay direct = {LensChoice::direct, CameraWay::goes_round};
  const FrameWay kept = {LensChoice::live, CameraWay::goes_round};
  const FrameWay live = {LensChoice::live, CameraWay::moves};
  add("sky/direct", dome(""), direct, {1024, 4096, 8192});
  add("sky/kept_grid", dome(""), kept, {1024, 4096, 8192});
  add("sky/live_grid", dome(""), live, {1024, 4096, 8192});
  add("bright_stars", dome("stars = \"bright_stars\"\nfaintest_mag = 10\n", every_effect), direct, {1024, 4096});
  const Show all_stars = dome("stars = \"all_stars\"\nfaintest_mag = 10\n", every_effect);
  add("all_stars", all_stars, direct, {4096});
  add("all_stars/kept_grid", all_stars, kept, {4096});
  add("all_stars/turning", all_stars, {LensChoice::live, CameraWay::turns}, {4096});
  add("all_stars/moving", all_stars, live, {4096});
  add("bright_stars_moving", dome("stars = \"bright_stars\"\nfaintest_mag = 10\n", every_effect),
      {LensChoice::direct, CameraWay::moves}, {1024});
  const Show published = published_show();
  add("published", published, kept, {1920});
  add("published/rays", published, direct, {1920});
  add("published/turning", published, {LensChoice::live, CameraWay::turns}, {1920});
  add("published/standing", published, {LensChoice::live, CameraWay::stands}, {1920});
  add("published/moving", published, live, {1920});
  add("two_eyes", two_eyes(), direct, {2048});
  for (const char* const name : {"disk", "shells", "planet"}) {
    add(name, built_in(name), direct, {1920});
  }
  add_picture("two_eyes", two_eyes(), 2048);
  add_picture("sky", dome(""), 4096);
  add_picture("bright_stars", dome("stars = \"bright_stars\"\nfaintest_mag = 10\n", every_effect), 4096);
  add_cuda_object_benchmarks();
  add_cuda_projector_benchmarks();
  add_cuda_headset_benchmarks();
}
