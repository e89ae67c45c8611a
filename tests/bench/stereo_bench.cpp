#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <memory>
#include <string>
#include <vector>

#include "content/show/reading/show_reader.h"
#include "kernels/launch/parallel_for.h"
#include "render/frame/show_renderer.h"
#include "render/stereo/eye_disparity.h"

// Times of frames with both eyes compared with frames of one eye, rendered into memory.
namespace {

using namespace ergodome;

Show bench_show(const char* stereo) {
  return parse_show(
      std::string("[hole]\nspin = 0.999\n[camera]\n[[camera.key]]\nr = 8\npitch_deg = -25\n"
                  "[view]\nprojection = \"dome\"\ntilt_deg = 30\n[sky]\nmap = \"milky_way\"\n[stereo]\n") +
          stereo,
      "bench.toml");
}

constexpr const char* physical_eyes = "layout = \"separate\"\nbaseline = 0.1\n";
constexpr const char* flat_eyes = "layout = \"separate\"\nbaseline = 0.1\nmodel = \"flat\"\n";
constexpr const char* omni_eyes = "layout = \"separate\"\nbaseline = 0.1\nmodel = \"omni\"\n";

//! Moves a camera to its next position.
using CameraStep = void (*)(CameraPose& pose);

void stereo_frames(benchmark::State& state, const char* stereo, CameraStep step) {
  const int size = static_cast<int>(state.range(0));
  const Show show = bench_show(stereo);
  ShowRenderer renderer(show, Backend::cpu);
  const Projection projection = make_projection(show.view, size, 0.0);
  CameraPose pose = camera_pose(show, 0.0);
  // The first frame also maps memory, which takes as long as rendering.
  static_cast<void>(renderer.render_window_parts(pose, projection, ViewMode::sky));
  for (auto _ : state) {
    step(pose);
    benchmark::DoNotOptimize(renderer.render_window_parts(pose, projection, ViewMode::sky).front().rgba.data());
  }
  state.SetLabel(std::string(name_of(active_instruction_set())) + ", " + std::to_string(thread_count()) + " threads");
}

//! Measures frames of a camera that comes closer from frame to frame, so that no grid can be
//! reused.
void stereo_frame(benchmark::State& state, const char* stereo) {
  stereo_frames(state, stereo, [](CameraPose& pose) { pose.r -= 1e-6; });
}

//! Measures frames of a camera that goes around the hole and keeps facing it, so that its grids are
//! reused.
void stereo_round(benchmark::State& state, const char* stereo) {
  stereo_frames(state, stereo, [](CameraPose& pose) { pose.phi += 0.0031; });
}

void stereo_sizes(benchmark::internal::Benchmark* benchmark) {
  benchmark->Arg(1024)->Arg(2048)->Unit(benchmark::kMillisecond)->UseRealTime();
}

BENCHMARK_CAPTURE(stereo_frame, mono, "")->Apply(stereo_sizes);
BENCHMARK_CAPTURE(stereo_frame, physical, physical_eyes)->Apply(stereo_sizes);
BENCHMARK_CAPTURE(stereo_frame, flat, flat_eyes)->Apply(stereo_sizes);
BENCHMARK_CAPTURE(stereo_frame, omni, omni_eyes)->Apply(stereo_sizes);
BENCHMARK_CAPTURE(stereo_round, mono, "")->Apply(stereo_sizes);
BENCHMARK_CAPTURE(stereo_round, physical, physical_eyes)->Apply(stereo_sizes);
BENCHMARK_CAPTURE(stereo_round, flat, flat_eyes)->Apply(stereo_sizes);
BENCHMARK_CAPTURE(stereo_round, omni, omni_eyes)->Apply(stereo_sizes);

//! Renders both eyes of the built-in disk show with the camera at rest, so that grids are reused.
void stereo_disk(benchmark::State& state, const char* stereo, const char* pattern) {
  const Show show = parse_show(
      std::string("[hole]\nspin = 0.999\n[camera]\nobserver = \"zamo\"\n[[camera.key]]\nr = 60\ntheta_deg = 83\n"
                  "[sky]\nmap = \"milky_way\"\n[effects]\nredshift = true\n[disk]\nouter = 18\ntemperature_K = 20000\n"
                  "limb_darkening = true\n") +
          pattern + "[view]\nprojection = \"pinhole\"\nfov_deg = 40\naspect = 1.7777778\n[stereo]\n" + stereo,
      "bench.toml");
  ShowRenderer renderer(show, Backend::cpu, LensChoice::live);
  const Projection projection = make_projection(show.view, static_cast<int>(state.range(0)), 0.0);
  const CameraPose pose = camera_pose(show, 0.0);
  for (auto _ : state) {
    benchmark::DoNotOptimize(renderer.render_window_parts(pose, projection, ViewMode::sky).front().rgba.data());
  }
  state.SetLabel(std::string(name_of(active_instruction_set())) + ", " + std::to_string(thread_count()) + " threads");
}

constexpr const char* clouds = "pattern = \"procedural\"\n";

void disk_pair_width(benchmark::internal::Benchmark* benchmark) {
  benchmark->Arg(960)->Unit(benchmark::kMillisecond)->UseRealTime();
}

BENCHMARK_CAPTURE(stereo_disk, mono, "", "")->Apply(disk_pair_width);
BENCHMARK_CAPTURE(stereo_disk, physical, physical_eyes, "")->Apply(disk_pair_width);
BENCHMARK_CAPTURE(stereo_disk, flat, flat_eyes, "")->Apply(disk_pair_width);
BENCHMARK_CAPTURE(stereo_disk, mono_clouds, "", clouds)->Apply(disk_pair_width);
BENCHMARK_CAPTURE(stereo_disk, physical_clouds, physical_eyes, clouds)->Apply(disk_pair_width);
BENCHMARK_CAPTURE(stereo_disk, flat_clouds, flat_eyes, clouds)->Apply(disk_pair_width);

//! Renders both eyes of a show with a ball behind a spinning hole, drawn by traced rays. The
//! argument is the baseline in hundredths of M.
void stereo_objects(benchmark::State& state, const char* model) {
  const Show show = parse_show(
      "[hole]\nspin = 0.9\n[[camera.key]]\nr = 24\ntheta_deg = 75\n[sky]\nmap = \"black\"\n[[objects]]\nmethod = "
      "\"trace\"\n"
      "shape = \"sphere\"\nsegments = 96\nrings = 48\nposition = [-7, 5, 3]\nsize = 3\n[view]\nprojection = "
      "\"pinhole\"\n"
      "fov_deg = 60\naspect = 1.5\n[stereo]\nlayout = \"separate\"\nmodel = \"" +
          std::string(model) + "\"\nbaseline = " + std::to_string(0.01 * static_cast<double>(state.range(0))) + "\n",
      "bench.toml");
  constexpr int width_px = 300;
  ShowRenderer renderer(show, Backend::cpu);
  const Projection projection = make_projection(show.view, width_px, 0.0);
  const CameraPose pose = camera_pose(show, 0.0);
  for (auto _ : state) {
    benchmark::DoNotOptimize(renderer.render_window_parts(pose, projection, ViewMode::sky).front().rgba.data());
  }
  state.SetLabel(std::string(name_of(active_instruction_set())) + ", " + std::to_string(thread_count()) + " threads");
}

void object_baselines(benchmark::internal::Benchmark* benchmark) {
  benchmark->Arg(10)->Arg(50)->Arg(150)->Unit(benchmark::kMillisecond)->UseRealTime();
}

BENCHMARK_CAPTURE(stereo_objects, physical, "physical")->Apply(object_baselines);
BENCHMARK_CAPTURE(stereo_objects, flat, "flat")->Apply(object_baselines);

//! Measures how long the program takes to compute the disparity of an eye pair.
void stereo_disparity(benchmark::State& state, const char* things, const char* model) {
  Show show = parse_show(
      std::string("[hole]\nspin = 0.9\n[camera]\n[[camera.key]]\nr = 24\ntheta_deg = 75\n[sky]\nmap = \"black\"\n"
                  "[view]\nprojection = \"pinhole\"\nfov_deg = 70\n") +
          things + "[stereo]\nlayout = \"separate\"\nbaseline = 0.1\nmodel = \"" + model + "\"\n",
      "bench.toml");
  const ShowRenderer renderer(show, Backend::cpu);
  show.sky.map = "milky_way";  // disparity ignores a black sky
  const CameraPose pose = camera_pose(show, 0.0);
  const Projection projection = make_projection(show.view, 1024, 0.0);
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        frame_disparity(show, pose, projection, renderer.object_outlines(), renderer.hiding_objects()));
  }
}

constexpr const char* bench_ball =
    "[[objects]]\nmethod = \"trace\"\nshape = \"sphere\"\nposition = [12, 4, 3]\nsize = 1\n";
constexpr const char* disk_and_shell = "[disk]\nouter = 12\n[[shells]]\nradius = 9\n";

BENCHMARK_CAPTURE(stereo_disparity, sky, "", "physical")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(stereo_disparity, ball, bench_ball, "physical")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(stereo_disparity, disk_and_shell, disk_and_shell, "physical")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(stereo_disparity, disk_and_shell_omni, disk_and_shell, "omni")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(stereo_disparity, disk_and_shell_flat, disk_and_shell, "flat")->Unit(benchmark::kMillisecond);

//! Returns the CPU time of all threads [s], so that other programs do not count.
double processor_s() {
  std::timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double middle(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

double clock_s() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

//! Renders frames without stereo ("mono") and in each stereo model, in turn. Reports the median
//! time of a mono frame. For each ratio, such as that of the model `flat` to mono, reports the
//! median, minimum and maximum over the rounds, in CPU time and in wall-clock time.
void stereo_in_turn(benchmark::State& state) {
  const int size = static_cast<int>(state.range(0));
  constexpr const char* models[] = {"", physical_eyes, flat_eyes, omni_eyes};
  std::vector<std::unique_ptr<ShowRenderer>> renderers;
  for (const char* const model : models) {
    renderers.push_back(std::make_unique<ShowRenderer>(bench_show(model), Backend::cpu));
  }
  const Projection projection = make_projection(renderers[0]->show().view, size, 0.0);
  CameraPose pose = camera_pose(renderers[0]->show(), 0.0);
  for (const auto& renderer : renderers) {
    static_cast<void>(renderer->render_window_parts(pose, projection, ViewMode::sky));
  }
  std::vector<double> times[4];
  std::vector<double> clock_times[4];
  for (auto _ : state) {
    pose.r -= 1e-6;
    for (std::size_t i = 0; i < 4; ++i) {
      const double begin = processor_s();
      const double clock_begin = clock_s();
      benchmark::DoNotOptimize(renderers[i]->render_window_parts(pose, projection, ViewMode::sky).data());
      times[i].push_back(processor_s() - begin);
      clock_times[i].push_back(clock_s() - clock_begin);
    }
  }
  const auto ratios = [&](std::size_t above, std::size_t below, const std::string& name, bool by_clock = false) {
    const auto& taken = by_clock ? clock_times : times;
    std::vector<double> each;
    each.reserve(taken[above].size());
    for (std::size_t i = 0; i < taken[above].size(); ++i) {
      each.push_back(taken[above][i] / taken[below][i]);
    }
    state.counters[name] = middle(each);
    state.counters[name + "_least"] = *std::ranges::min_element(each);
    state.counters[name + "_most"] = *std::ranges::max_element(each);
  };
  state.counters["mono_ms"] = 1e3 * middle(times[0]);
  ratios(1, 0, "physical_over_mono");
  ratios(2, 0, "flat_over_mono");
  ratios(3, 1, "omni_over_physical");
  ratios(1, 0, "clock_physical_over_mono", true);
  ratios(2, 0, "clock_flat_over_mono", true);
}

BENCHMARK(stereo_in_turn)->Apply(stereo_sizes);

}  // namespace
