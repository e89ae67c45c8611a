#include <benchmark/benchmark.h>
#include <epoxy/gl.h>

#include <chrono>
#include <cmath>
#include <memory>
#include <string>

#include "content/show_reader.h"
#include "kernels/core/error.h"
#include "kernels/launch/parallel_for.h"
#include "render/frame/show_renderer.h"
#include "render/present/headless_context.h"
#include "render/present/offscreen_frame.h"
#include "render/present/projector_drawing.h"

// What a projector adds to a frame: the master is rendered by the CPU, then warped and blended by OpenGL, on the GPU or by Mesa's software.
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

double seconds(const auto& action) {
  const auto start = Clock::now();
  action();
  glFinish();
  return std::chrono::duration<double>(Clock::now() - start).count();
}

//! Means over the run: the master's rendering, its upload, its tone and averages (once for all projectors), and the projector's drawing.
//! `share`: tone, averages and drawing over the rendering.
void projector(benchmark::State& state) {
  std::unique_ptr<HeadlessContext> context;
  try {
    context = std::make_unique<HeadlessContext>();
  } catch (const Error& problem) {
    state.SkipWithError(problem.what());
    return;
  }
  const int size = static_cast<int>(state.range(0));
  ShowRenderer renderer(parse_show("[hole]\nspin = 0.999\n[camera]\n[[camera.key]]\nr = 5\npitch_deg = -25\n"
                                   "[view]\nprojection = \"dome\"\ntilt_deg = 30\n[sky]\nmap = \"milky_way\"\n",
                                   "bench.toml"),
                        Backend::cpu, LensChoice::live);
  const Projection projection = make_projection(renderer.show().view, size, 0.0);
  const CameraPose pose = camera_pose(renderer.show(), 0.0);
  const OffscreenFrame raster(2560, 1600);
  Presenter presenter;
  DisplayLight light;
  ProjectorDrawing drawing(wide_projector());
  double sums[4] = {};
  for (auto _ : state) {
    Picture master;
    sums[0] += seconds([&] { master = renderer.render_eye(pose, 0.0, projection, ViewMode::sky); });
    sums[1] += seconds([&] { presenter.upload(master); });
    sums[2] += seconds([&] { light.update(presenter.shown()); });
    raster.bind();
    sums[3] += seconds([&] { drawing.draw(light, 2560, 1600); });
  }
  const char* const names[4] = {"render_ms", "upload_ms", "tone_ms", "warp_ms"};
  for (int i = 0; i < 4; ++i) {
    state.counters[names[i]] = 1e3 * sums[i] / static_cast<double>(state.iterations());
  }
  state.counters["share"] = (sums[2] + sums[3]) / sums[0];
  state.SetLabel(std::string(reinterpret_cast<const char*>(glGetString(GL_RENDERER))) + ", " +
                 std::to_string(thread_count()) + " threads");
}

BENCHMARK(projector)->Arg(1024)->Arg(2048)->Arg(4096)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
