#include <benchmark/benchmark.h>
#include <epoxy/gl.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <memory>
#include <string>
#include <vector>

#include "content/show/reading/show_reader.h"
#include "kernels/core/error.h"
#include "kernels/launch/launch.h"
#include "kernels/launch/parallel_for.h"
#include "render/frame/show_renderer.h"
#include "render/opengl/headless_context.h"
#include "render/present/projectors/projector_drawing.h"
#include "render/present/projectors/software_projectors.h"
#include "tests/bench/cuda_bench.h"

// The cost of a projector per frame. First the CPU renders the domemaster; then it is warped and
// blended twice, by OpenGL (on the GPU or by Mesa's software renderer) and by the CPU. In the
// benchmarks for CUDA, all of this runs on the GPU.
namespace {

using namespace ergodome;
using Clock = std::chrono::steady_clock;

//! Returns the picture of a 2560 x 1600 projector that lights a fifth of the dome. Blend mask and
//! warp are computed from its lens and pose.
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

//! Returns the renderer of a dome show at 5 M from a fast-spinning hole. The lens grid is built
//! once, because the camera does not move.
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

//! Returns the CPU time of an action, summed over all threads of this process, so that other
//! programs have little influence [s].
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

//! Measures a projector, and reports mean times over the run.
//!
//! render_ms: rendering of the domemaster. gl_upload_ms, gl_tone_ms: upload, tone curve and
//! averages in OpenGL, once for all projectors. gl_warp_ms: drawing of the projector. cpu_tone_ms:
//! tone curve and averages of the part of the domemaster that the projector shows. cpu_warp_ms:
//! drawing of the projector. gl_share, cpu_share: tone curve, averages and drawing, relative to
//! rendering; the CPU shares are ratios of CPU times frame by frame, with their minimum and
//! maximum.
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
      software.show(master);  // computes the warp
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

//! Renders a sequence of domemasters by CUDA and keeps them on the GPU. The camera moves around the
//! hole by a tiny angle from each to the next.
class DeviceMasters {
 public:
  explicit DeviceMasters(int size_px)
      : renderer_(master_renderer(Backend::cuda)),
        projection_(make_projection(renderer_.show().view, size_px, 0.0)),
        pose_(camera_pose(renderer_.show(), 0.0)) {}

  //! Renders the next domemaster; returns the time that this takes [s].
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

//! Measures the projector with OpenGL: upload of the domemaster, tone curve and averages, drawing.
void draw_by_opengl(DeviceMasters& masters, benchmark::State& state) {
  const OffscreenFrame raster(2560, 1600);
  Presenter presenter;
  DisplayLight light;
  ProjectorDrawing drawing(wide_projector());
  raster.bind();
  double sums[4] = {};
  // The first three frames do not count, because the driver defers some of its work to the first
  // calls.
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

//! Measures a projector on the GPU that renders the domemaster, and reports mean times over the
//! run: rendering; tone curve, averages and drawing of the projector by CUDA, with a single
//! synchronization; then tone curve and averages alone. Shares are the times of tone curve,
//! averages and drawing relative to rendering, frame by frame.
void cuda_projector(benchmark::State& state) {
  DeviceMasters masters(static_cast<int>(state.range(0)));
  SoftwareProjectors projectors({wide_projector()}, Backend::cuda);
  const auto light = [&] { projectors.show_in_place(masters.picture()); };
  for (int i = 0; i < 3; ++i) {
    masters.next();
    light();  // the first call computes the warp
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
