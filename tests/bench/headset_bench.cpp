#include <benchmark/benchmark.h>
#include <epoxy/gl.h>

#include <memory>
#include <string>

#include "content/show/reading/show_reader.h"
#include "kernels/launch/parallel_for.h"
#include "kernels/projection/cube_faces.h"
#include "kernels/projection/make_projection.h"
#include "render/frame/show_renderer.h"
#include "render/opengl/headless_context.h"
#include "render/present/headset/eye_painter.h"
#include "render/present/presenter.h"
#include "tests/bench/cuda_bench.h"

// The cost of a headset next to that of a stereo window: what every frame draws with OpenGL, and
// what a new position of the camera renders.
namespace {

using namespace ergodome;

//! Eyes' pictures of a common headset [px], and the angle of their pixels [rad].
constexpr ImageSize eye_size = {2064, 2208};
constexpr double eye_pixel = 2.0 / 2064;

Show headset_show(const std::string& view, bool stars, const std::string& model = "flat") {
  return parse_show(std::string("[hole]\nspin = 0.999\n[[camera.key]]\nr = 8\n[sky]\nmap = \"milky_way\"\n") +
                        (stars ? "stars = \"bright_stars\"\n" : "") + "[stereo]\nlayout = \"separate\"\nmodel = \"" +
                        model + "\"\nbaseline = 0.05\n[view]\n" + view,
                    "bench.toml");
}

Show panorama_show(bool stars, const std::string& model = "flat") {
  return headset_show("projection = \"cube\"\ncube_layout = \"strip\"\n", stars, model);
}
Show window_show(bool stars) { return headset_show("projection = \"pinhole\"\nfov_deg = 90\naspect = 0.935\n", stars); }

std::string opengl_name() { return reinterpret_cast<const char*>(glGetString(GL_RENDERER)); }

//! A framebuffer as large as a picture of both eyes.
void make_framebuffer() {
  unsigned texture = 0;
  unsigned framebuffer = 0;
  glCreateTextures(GL_TEXTURE_2D, 1, &texture);
  glTextureStorage2D(texture, 1, GL_RGBA8, 2 * eye_size.width, eye_size.height);
  glCreateFramebuffers(1, &framebuffer);
  glNamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, texture, 0);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
}

//! Draws both eyes of a headset from a panorama: what each of its frames costs, also while the head
//! turns.
void headset_frame(benchmark::State& state, bool stars) {
  const HeadlessContext context;
  make_framebuffer();
  ShowRenderer renderer(panorama_show(stars), Backend::cpu);
  renderer.set_stars_apart(eye_pixel);
  const Projection projection = make_projection(renderer.show().view, cube_faces * 512, 0.0);
  std::vector<Picture> eyes =
      renderer.render_window_parts(camera_pose(renderer.show(), 0.0), projection, ViewMode::sky);
  OutputFrame frame;
  frame.picture = std::move(eyes[0]);
  frame.right_eye = std::move(eyes[1]);
  Panorama panorama;
  panorama.set(frame);
  EyePainter painter;
  HeadsetEye view;
  view.sides = {-1.2, 1.0, 1.1, -1.1};
  double angle = 0.0;
  for (auto _ : state) {
    view.turn = glm::angleAxis(angle += 0.01, glm::dvec3(0.0, 1.0, 0.0));
    painter.draw(panorama, 0, view, {}, eye_size, true);
    painter.draw(panorama, 1, view, {}, eye_size, true);
    glFinish();
  }
  state.SetLabel(opengl_name());
}

//! Draws the same number of pixels in a window: two finished pictures.
void window_frame(benchmark::State& state) {
  const HeadlessContext context;
  make_framebuffer();
  Picture picture;
  picture.width = 2 * eye_size.width;
  picture.height = eye_size.height;
  picture.rgba.assign(std::size_t{4} * eye_size.width * 2 * eye_size.height, 0.1F);
  Presenter presenter;
  presenter.upload(picture);
  for (auto _ : state) {
    presenter.draw(picture.width, picture.height);
    glFinish();
  }
  state.SetLabel(opengl_name());
}

//! Renders both eyes' pictures for a new position of the camera: six faces, or a window's two
//! pictures. The argument is the width of a face or of an eye's picture.
void new_position(benchmark::State& state, const Show& show, bool panorama) {
  const int width = static_cast<int>(state.range(0)) * (panorama ? cube_faces : 1);
  ShowRenderer renderer(show, Backend::cpu);
  renderer.set_stars_apart(panorama ? eye_pixel : 0.0);
  const Projection projection = make_projection(show.view, width, 0.0);
  CameraPose pose = camera_pose(show, 0.0);
  for (auto _ : state) {
    pose.r -= 1e-6;
    benchmark::DoNotOptimize(renderer.render_window_parts(pose, projection, ViewMode::sky).front().rgba.data());
  }
  state.SetLabel(std::string(name_of(active_instruction_set())) + ", " + std::to_string(thread_count()) + " threads");
}

void headset_position(benchmark::State& state, bool stars) { new_position(state, panorama_show(stars), true); }
void window_position(benchmark::State& state, bool stars) { new_position(state, window_show(stars), false); }

//! Renders both eyes' panoramas on a GPU, as the player does, and gives them to the panorama.
void render_on_gpu(ShowRenderer& renderer, const CameraPose& pose, const Projection& projection, Panorama& panorama) {
  OutputFrame frame;
  if (renderer.may_stay_in_place(ViewMode::sky)) {
    const BackendEyes eyes = renderer.render_eyes_in_place(pose, projection, ViewMode::sky, {});
    DevicePicture& picture = frame.on_device.emplace();
    picture.rgba = eyes.first.rgba;
    picture.right = eyes.right ? eyes.right->rgba : nullptr;
    picture.width_px = projection.width_px;
    picture.height_px = projection.height_px;
    picture.stars = eyes.first.stars;
    picture.right_stars = eyes.right ? eyes.right->stars : nullptr;
  } else {
    std::vector<Picture> eyes = renderer.render_window_parts(pose, projection, ViewMode::sky);
    frame.picture = std::move(eyes.front());
    frame.right_eye = std::move(eyes.back());
  }
  panorama.set(frame);
}

//! A frame of a headset on a GPU: draws both eyes while the head turns, after rendering a new
//! position if the camera flies. The argument is the width of a face of the cube.
void cuda_headset(benchmark::State& state, const Show& show, bool flies) {
  const HeadlessContext context;
  make_framebuffer();
  ShowRenderer renderer(show, Backend::cuda);
  renderer.set_stars_apart(eye_pixel);
  const Projection projection = make_projection(show.view, cube_faces * static_cast<int>(state.range(0)), 0.0);
  CameraPose pose = camera_pose(show, 0.0);
  Panorama panorama;
  EyePainter painter;
  HeadsetEye view;
  view.sides = {-1.2, 1.0, 1.1, -1.1};
  double angle = 0.0;
  const auto draw = [&] {
    view.turn = glm::angleAxis(angle += 0.01, glm::dvec3(0.0, 1.0, 0.0));
    painter.draw(panorama, 0, view, {}, eye_size, true);
    painter.draw(panorama, 1, view, {}, eye_size, true);
    glFinish();
  };
  render_on_gpu(renderer, pose, projection, panorama);
  draw();
  for (auto _ : state) {
    if (flies) {
      pose.r -= 1e-6;
      render_on_gpu(renderer, pose, projection, panorama);
    }
    draw();
  }
  state.SetLabel(opengl_name());
}

void gl_times(benchmark::internal::Benchmark* benchmark) { benchmark->Unit(benchmark::kMillisecond)->UseRealTime(); }
void widths(benchmark::internal::Benchmark* benchmark) {
  benchmark->Arg(512)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();
}

BENCHMARK(window_frame)->Apply(gl_times);
BENCHMARK_CAPTURE(headset_frame, map, false)->Apply(gl_times);
BENCHMARK_CAPTURE(headset_frame, stars, true)->Apply(gl_times);
BENCHMARK_CAPTURE(window_position, map, false)->Apply(widths);
BENCHMARK_CAPTURE(headset_position, map, false)->Apply(widths);
BENCHMARK_CAPTURE(window_position, stars, true)->Apply(widths);
BENCHMARK_CAPTURE(headset_position, stars, true)->Apply(widths);

}  // namespace

void ergodome::add_cuda_headset_benchmarks() {
  for (const char* const model : {"flat", "omni", "physical"}) {
    for (const bool stars : {false, true}) {
      for (const bool flies : {false, true}) {
        const std::string name =
            std::string("cuda_headset/") + model + (stars ? "/stars" : "/map") + (flies ? "/flying" : "/turning");
        auto* const made = benchmark::RegisterBenchmark(
            name.c_str(),
            [show = panorama_show(stars, model), flies](benchmark::State& state) { cuda_headset(state, show, flies); });
        made->Unit(benchmark::kMillisecond)->UseRealTime()->Arg(2048)->Arg(1024);
      }
    }
  }
}
