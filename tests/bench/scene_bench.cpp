#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <array>
#include <glm/gtc/quaternion.hpp>
#include <string>

#include "content/show/reading/show_reader.h"
#include "kernels/launch/parallel_for.h"
#include "render/frame/show_renderer.h"

// Frames of a show as a film has them, in processor time of all threads: for standing, turning and
// moving cameras, by content, stereo model and size. For comparing programs.
namespace {

using namespace ergodome;

enum class SceneCamera { still, turns, moves };

struct SceneName {
  const char* name;
  const char* text;
};

constexpr std::array<SceneName, 3> scene_contents = {
    {{"map", ""}, {"stars", "stars = \"bright_stars\"\n"}, {"disk", "[disk]\ninner = \"isco\"\nouter = 12\n"}}};
constexpr std::array<SceneName, 3> scene_eyes = {
    {{"mono", ""},
     {"physical", "[stereo]\nlayout = \"separate\"\nbaseline = 0.1\n"},
     {"flat", "[stereo]\nlayout = \"separate\"\nbaseline = 0.1\nmodel = \"flat\"\n"}}};

void scene(benchmark::State& state, SceneCamera camera, const std::string& more) {
  const Show show = parse_show(
      "duration_s = 60\n[hole]\nspin = 0.9\n[camera]\nobserver = \"zamo\"\n"
      "[[camera.key]]\nt_s = 0\nr = 14\ntheta_deg = 84\npitch_deg = -25\n"
      "[[camera.key]]\nt_s = 60\nr = 8\ntheta_deg = 90\nphi_deg = 300\npitch_deg = -25\n"
      "[view]\nprojection = \"dome\"\nfov_deg = 180\ntilt_deg = 30\n[sky]\nmap = \"milky_way\"\n" +
          more,
      "scene.toml");
  ShowRenderer renderer(show, Backend::cpu);
  const Projection projection = make_projection(show.view, static_cast<int>(state.range(0)), 0.0);
  double time_s = 30.0;
  CameraPose pose = camera_pose(show, time_s);
  const auto render = [&] {
    if (camera == SceneCamera::moves) {
      time_s += 1.0 / show.frame_rate_hz;
      pose = camera_pose(show, time_s);
    } else if (camera == SceneCamera::turns) {
      pose.orientation *= glm::angleAxis(0.01, glm::dvec3(0.0, 1.0, 0.0));
    }
    renderer.apply(time_s);
    benchmark::DoNotOptimize(
        renderer.render_window_parts(pose, projection, ViewMode::sky, {time_s}).front().rgba.data());
  };
  render();
  for (auto _ : state) {
    render();
  }
  state.SetLabel(fmt::format("{}, {} threads", name_of(active_instruction_set()), thread_count()));
}

//! Registers a benchmark for each camera, content, stereo model and size.
bool register_scenes() {
  constexpr std::array cameras = {"still", "turns", "moves"};
  for (const SceneName& eyes : scene_eyes) {
    for (const SceneName& content : scene_contents) {
      for (std::size_t camera = 0; camera < cameras.size(); ++camera) {
        for (const int size : {512, 1024, 2048, 4096}) {
          // A moving camera enters a new cell of star patches about every 150 frames, so the time of
          // a cell is mostly not in these frames.
          const int frames = camera == 2 ? 30 : 6;
          benchmark::RegisterBenchmark(
              fmt::format("scene/{}/{}/{}", eyes.name, content.name, cameras.at(camera)).c_str(),
              [more = std::string(content.text) + eyes.text, camera](benchmark::State& state) {
                scene(state, static_cast<SceneCamera>(camera), more);
              })
              ->Arg(size)
              ->Iterations(size == 4096 ? frames / 3 : frames)
              ->Unit(benchmark::kMillisecond)
              ->MeasureProcessCPUTime();
        }
      }
    }
  }
  return true;
}

const bool scenes_registered = register_scenes();

}  // namespace
