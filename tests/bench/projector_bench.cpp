#include <benchmark/benchmark.h>
#include <epoxy/gl.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <memory>
#include <string>
#include <vector>

#include "content/show/show_reader.h"
#include "kernels/core/error.h"
#include "kernels/launch/launch.h"
#include "kernels/launch/parallel_for.h"
#include "render/frame/show_renderer.h"
#include "render/present/headless_context.h"
#include "render/present/offscreen_frame.h"
#include "render/present/projectors/projector_drawing.h"
#include "render/present/projectors/software_projectors.h"
#include "tests/bench/cuda_bench.h"

// What a projector adds to a frame: the master is rendered by the CPU, then warped and blended by OpenGL, on the GPU or by Mesa's software,
// and by the CPU; or, where there is CUDA, all of it on the device.
namespace {

using namespace ergodome;
using Clock = std::chrono::steady_clock;

//! A projector of 2560 x 1600 that fills a fifth of the dome, its blend and warp computed from its place.
ProjectorPicture wide_projector() {
  DomeSetup setup;
  setup.radius_m = 8.0;
  ProjectorSetup projector;
  projector.name = "bench";
  projector.position_m = {0.0, 0.0, 1.0};
  projector.orientation = {10.0, 40.0, 2.0};
  projector.lens = Frustum{-40.0, 40.0, 30.0, -30.0};
  projector.width_px = 2560;
  projector.height_px = 1600;
  projector.black_level_lift = {0.01, 0.01, 0.01};
  setup.projectors.push_back(projector);
  return projector_pictures(setup).front();
}

//! A dome five M from a fast hole, whose lens is kept.
ShowRenderer master_renderer(Backend backend) {
  return {parse_show("[hole]\nspin = 0.999\n[camera]\n[[camera.key]]\nr = 5\npitch_deg = -25\n"
                     "[view]\nprojection = \"dome\"\ntilt_deg = 30\n[sky]\nmap = \"milky_way\"\n",
                     "bench.toml"),
          backend, LensChoice::live};
}

std::string opengl_renderer() { return reinterpret_cast<const char*>(glGetString(GL_RENDERER)); }

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

double seconds(const auto& action) {
  const auto start = Clock::now();
  action();
  return std::chrono::duration<double>(Clock::now() - start).count();
}

//! The same in the time of processors, of all threads: other programs do not count.
double processor_seconds(const auto& action) {
  const auto now = [] {
    std::timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  };
  const double start = now();
  action();
  return now() - start;
}

//! Means over the run: the master's rendering; by OpenGL its upload, its tone and averages (once for all projectors), and the projector's
//! drawing; by the CPU tone and averages of what the projector shows, and its drawing. Shares: tone, averages and drawing over the rendering;
//! the CPU's, each frame by itself and in processor time, with the least and the greatest.
void projector(benchmark::State& state) {
  std::unique_ptr<HeadlessContext> context;
  try {
    context = std::make_unique<HeadlessContext>();
  } catch (const Error& problem) {
    state.SkipWithError(problem.what());
    return;
  }
  const int size = static_cast<int>(state.range(0));
  ShowRenderer renderer = master_renderer(Backend::cpu);
  const Projection projection = make_projection(renderer.show().view, size, 0.0);
  const CameraPose pose = camera_pose(renderer.show(), 0.0);
  const OffscreenFrame raster(2560, 1600);
  Presenter presenter;
  DisplayLight light;
  ProjectorDrawing drawing(wide_projector());
  SoftwareProjectors software({wide_projector()});
  std::vector<std::uint8_t> rgb(std::size_t{3} * 2560 * 1600);
  double sums[6] = {};
  std::vector<double> shares;
  for (auto _ : state) {
    Picture master;
    const double render = processor_seconds(
        [&] { sums[0] += seconds([&] { master = renderer.render_eye(pose, 0.0, projection, ViewMode::sky); }); });
    sums[1] += seconds([&] {
      presenter.upload(master);
      glFinish();
    });
    sums[2] += seconds([&] {
      light.update(presenter.shown());
      glFinish();
    });
    raster.bind();
    sums[3] += seconds([&] {
      drawing.draw(light, 2560, 1600);
      glFinish();
    });
    if (shares.empty()) {
      software.show(master);  // works the warp out
    }
    shares.push_back(processor_seconds([&] {
                       sums[4] += seconds([&] { software.show(master); });
                       sums[5] += seconds([&] { software.frame(0, rgb.data()); });
                     }) /
                     render);
  }
  const char* const names[6] = {"render_ms", "gl_upload_ms", "gl_tone_ms", "gl_warp_ms", "cpu_tone_ms", "cpu_warp_ms"};
  for (int i = 0; i < 6; ++i) {
    state.counters[names[i]] = 1e3 * sums[i] / static_cast<double>(state.iterations());
  }
  state.counters["gl_share"] = (sums[2] + sums[3]) / sums[0];
  state.counters["cpu_share"] = median(shares);
  state.counters["cpu_share_least"] = std::ranges::min(shares);
  state.counters["cpu_share_most"] = std::ranges::max(shares);
  state.SetLabel(opengl_renderer() + ", " + std::to_string(thread_count()) + " threads");
}

BENCHMARK(projector)->Arg(1024)->Arg(2048)->Arg(4096)->Unit(benchmark::kMillisecond)->UseRealTime();

//! Masters that CUDA renders one after the other and leaves on the device, with a camera that goes round by a hair.
class DeviceMasters {
 public:
  explicit DeviceMasters(int size_px)
      : renderer_(master_renderer(Backend::cuda)),
        projection_(make_projection(renderer_.show().view, size_px, 0.0)),
        pose_(camera_pose(renderer_.show(), 0.0)) {}

  //! How long the next one took.
  double next() {
    pose_.phi += 1e-9;
    return seconds([&] {
      rgba_ = renderer_.render_eyes_in_place(pose_, projection_, ViewMode::sky, {}).first.rgba;
      wait_for_device(Backend::cuda);
    });
  }

  [[nodiscard]] MasterPicture picture() const {
    return {rgba_, projection_.width_px, projection_.height_px, false, renderer_.tone()};
  }

 private:
  ShowRenderer renderer_;
  Projection projection_;
  CameraPose pose_;
  const float* rgba_ = nullptr;
};

constexpr int frames_beside = 20;

//! The same by OpenGL: handing the master over, its tone and averages, and the drawing.
void draw_by_opengl(DeviceMasters& masters, benchmark::State& state) {
  const OffscreenFrame raster(2560, 1600);
  Presenter presenter;
  DisplayLight light;
  ProjectorDrawing drawing(wide_projector());
  raster.bind();
  double sums[4] = {};
  // The driver does some of its work when it is asked first.
  for (int i = -3; i < frames_beside; ++i) {
    double parts[4] = {masters.next()};
    const MasterPicture master = masters.picture();
    parts[1] = seconds([&] {
      presenter.upload_from_device(
          {.rgba = master.rgba, .width_px = master.width, .height_px = master.height, .tone = master.tone});
      glFinish();
    });
    parts[2] = seconds([&] {
      light.update(presenter.shown());
      glFinish();
    });
    raster.bind();
    parts[3] = seconds([&] {
      drawing.draw(light, 2560, 1600);
      glFinish();
    });
    for (int k = 0; k < 4 && i >= 0; ++k) {
      sums[k] += parts[k];
    }
  }
  state.counters["gl_upload_ms"] = 1e3 * sums[1] / frames_beside;
  state.counters["gl_tone_ms"] = 1e3 * sums[2] / frames_beside;
  state.counters["gl_warp_ms"] = 1e3 * sums[3] / frames_beside;
  state.counters["gl_share"] = (sums[2] + sums[3]) / sums[0];
}

//! Means over the run: the master's rendering, and tone, averages and drawing of the projector on the same device, which is waited for once; of that
//! by itself, afterwards, tone and averages. Shares: tone, averages and drawing over the rendering, of each frame by itself.
void cuda_projector(benchmark::State& state) {
  DeviceMasters masters(static_cast<int>(state.range(0)));
  SoftwareProjectors projectors({wide_projector()}, Backend::cuda);
  const auto light = [&] { projectors.show_in_place(masters.picture()); };
  for (int i = 0; i < 3; ++i) {
    masters.next();
    light();  // works the warp out
    projectors.draw_in_place();
  }
  double sums[2] = {};
  std::vector<double> shares;
  for (auto _ : state) {
    const double render = masters.next();
    const double warp = seconds([&] {
      light();
      projectors.draw_in_place();
    });
    sums[0] += render;
    sums[1] += warp;
    shares.push_back(warp / render);
  }
  state.counters["render_ms"] = 1e3 * sums[0] / static_cast<double>(state.iterations());
  state.counters["warp_ms"] = 1e3 * sums[1] / static_cast<double>(state.iterations());
  state.counters["share"] = median(shares);
  state.counters["share_least"] = std::ranges::min(shares);
  state.counters["share_most"] = std::ranges::max(shares);
  double tone = 0.0;
  for (int i = 0; i < frames_beside; ++i) {
    masters.next();
    tone += seconds([&] {
      light();
      wait_for_device(Backend::cuda);
    });
  }
  state.counters["tone_alone_ms"] = 1e3 * tone / frames_beside;
  try {
    const HeadlessContext context;
    draw_by_opengl(masters, state);
    state.SetLabel(opengl_renderer());
  } catch (const Error& problem) {
    state.SetLabel(problem.what());
  }
}

}  // namespace

void ergodome::add_cuda_projector_benchmarks() {
  benchmark::RegisterBenchmark("cuda_projector", cuda_projector)
      ->Arg(1024)
      ->Arg(2048)
      ->Arg(4096)
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime();
}
