#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "app/player/renderers/frame_source.h"
#include "content/show/reading/show_reader.h"
#include "kernels/launch/work_counter.h"
#include "kernels/projection/make_projection.h"
#include "render/frame/show_renderer.h"
#include "render/output/tone_map.h"
#include "tests/app/cli/command_line.h"
#include "tests/support/openxr_runtime/test_head.h"

// The program in the headset of the test runtime: what it submits, and what becomes of it when the
// runtime misbehaves.

namespace ergodome::test {

namespace {

using nlohmann::json;
namespace xr = openxr_test;

//! A standing camera before a sky with structure everywhere, without what covers the sky.
constexpr const char* standing = R"(
[hole]
spin = 0.9
[[camera.key]]
r = 12
theta_deg = 80
phi_deg = 20
[sky]
map = "clouds.ppm"
[quality]
budget_px = 0.1
[headset]
stereo = "mono"
scale = 1e-9
rest_frame = false
panel = false
vignette = 0
fade_s = 0
)";

//! Returns that show with one part replaced.
std::string standing_with(const std::string& part, const std::string& replacement) {
  std::string show = standing;
  return show.replace(show.find(part), part.size(), replacement);
}

glm::dquat quaternion(const std::array<double, 4>& q) { return {q[3], q[0], q[1], q[2]}; }

//! Returns the direction of a head at a display time, to the left of the room's front [rad].
double heading_at(std::int64_t time_ns) {
  const glm::dvec3 forward = quaternion(xr::head_in_stage(time_ns).rotation) * glm::dvec3(0.0, 0.0, -1.0);
  return std::atan2(-forward.x, -forward.z);
}

//! A picture's luminance, 0 to 255, row by row.
struct Luminance {
  int width = 0;
  int height = 0;
  std::vector<double> values;

  [[nodiscard]] double at(int x, int y) const { return values[static_cast<std::size_t>(y) * width + x]; }
};

Luminance luminance_of(int width, int height, const std::uint8_t* rgb) {
  Luminance picture{width, height, {}};
  for (int i = 0; i < width * height; ++i) {
    picture.values.push_back(0.25 * rgb[3 * i] + 0.5 * rgb[3 * i + 1] + 0.25 * rgb[3 * i + 2]);
  }
  return picture;
}

Luminance read_picture(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string kind;
  int width = 0;
  int height = 0;
  int white = 0;
  stream >> kind >> width >> height >> white;
  stream.get();
  std::vector<std::uint8_t> rgb(static_cast<std::size_t>(3 * width * height));
  stream.read(reinterpret_cast<char*>(rgb.data()), static_cast<std::streamsize>(rgb.size()));
  EXPECT_TRUE(stream.good()) << file;
  return luminance_of(width, height, rgb.data());
}

//! Returns a picture blurred over a few pixels, so that the filters of its sampling hardly matter.
Luminance blurred(const Luminance& sharp) {
  constexpr int passes = 12;  // of [1 2 1] / 4: a standard deviation of 2.4 px
  Luminance picture = sharp;
  for (int pass = 0; pass < 2 * passes; ++pass) {
    const Luminance before = picture;
    const int right = pass % 2;
    const int down = 1 - right;
    for (int y = 1; y + 1 < picture.height; ++y) {
      for (int x = 1; x + 1 < picture.width; ++x) {
        picture.values[static_cast<std::size_t>(y) * picture.width + x] =
            0.5 * before.at(x, y) + 0.25 * (before.at(x + right, y + down) + before.at(x - right, y - down));
      }
    }
  }
  return picture;
}

//! Returns the length of the shift [px] of a tile of `shown` against `expected`, together with a
//! factor on the contrast: the least squares solution to first order. Both are blurred; `sharp` is
//! `expected` without blur. Returns nothing without enough structure in both directions, or if much
//! of it is so fine that the filters of the pictures matter. `left`, `top`: corner of the tile.
std::optional<double> tile_shift(const Luminance& shown, const Luminance& expected, const Luminance& sharp, int left,
                                 int top) {
  constexpr int tile_px = 32;
  double mean = 0.0;
  double fine = 0.0;
  double coarse = 0.0;
  for (int i = 0; i < tile_px * tile_px; ++i) {
    mean += expected.at(left + i % tile_px, top + i / tile_px) / (tile_px * tile_px);
  }
  glm::dmat3 normal(0.0);
  glm::dvec3 right_side(0.0);
  for (int i = 0; i < tile_px * tile_px; ++i) {
    const int x = left + i % tile_px;
    const int y = top + i / tile_px;
    const glm::dvec3 change(0.5 * (expected.at(x + 1, y) - expected.at(x - 1, y)),
                            0.5 * (expected.at(x, y + 1) - expected.at(x, y - 1)), expected.at(x, y) - mean);
    normal += glm::outerProduct(change, change);
    fine += std::pow(sharp.at(x, y) - expected.at(x, y), 2);
    coarse += std::pow(change.z, 2);
    right_side += (shown.at(x, y) - expected.at(x, y)) * change;
  }
  const double least = (normal[0][0] * normal[1][1] - normal[0][1] * normal[0][1]) / (normal[0][0] + normal[1][1]);
  // Limits: a mean square of the slope in 1/255 per pixel, and a part of the contrast.
  if (!(least > 1.0 * tile_px * tile_px) || fine > 0.1 * coarse) {
    return std::nullopt;
  }
  const glm::dvec3 solution = glm::inverse(normal) * right_side;
  return std::hypot(solution.x, solution.y);
}

//! Returns the shifts of all tiles [px], sorted.
std::vector<double> shifts(const Luminance& shown, const Luminance& expected) {
  constexpr int step_px = 32;
  constexpr int border_px = 8;
  const Luminance a = blurred(shown);
  const Luminance b = blurred(expected);
  std::vector<double> found;
  for (int top = border_px; top + step_px + border_px < a.height; top += step_px) {
    for (int left = border_px; left + step_px + border_px < a.width; left += step_px) {
      if (const std::optional<double> shift = tile_shift(a, b, expected, left, top)) {
        found.push_back(*shift);
      }
    }
  }
  std::ranges::sort(found);
  return found;
}

double at_part(const std::vector<double>& sorted, double part) {
  return sorted[static_cast<std::size_t>(part * static_cast<double>(sorted.size() - 1))];
}

}  // namespace

class HeadsetOutput : public CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    if (!has_display()) {
      GTEST_SKIP() << "no virtual display here (xvfb-run)";
    }
    write("show.toml", standing);
    // Smooth noise, so that shifts of a fraction of a pixel can be measured.
    std::string clouds = "P3 256 128 255\n";
    for (int y = 0; y < 128; ++y) {
      for (int x = 0; x < 256; ++x) {
        const double u = 6.28318530718 * x / 256.0;
        const double v = 6.28318530718 * y / 128.0;
        const auto wave = [&](double p, double q, double phase) { return std::sin(p * u + q * v + phase); };
        const double value = wave(11, 4, 0.1) + wave(-8, 9, 1.3) + wave(13, -5, 2.9) + wave(3, 12, 4.0);
        const std::string level = std::to_string(static_cast<int>(120 + 30 * value));
        for (int channel = 0; channel < 3; ++channel) {
          clouds.append(level).append("\n");
        }
      }
    }
    write("clouds.ppm", clouds);
  }

  //! Plays a show in the headset of the test runtime. Returns the exit status.
  int play(const std::string& script, const std::string& options = "", const std::string& show = "show.toml") {
    return run_on_display("play " + show + " --headset --backend cpu --quiet --no-sound " + options,
                          "XR_RUNTIME_JSON='" ERGODOME_OPENXR_RUNTIME
                          "' XR_ENABLE_API_LAYERS=XR_APILAYER_LUNARG_core_validation "
                          "XR_CORE_VALIDATION_EXPORT_TYPE=text XR_CORE_VALIDATION_FILE_NAME=validation.txt "
                          "XDG_STATE_HOME=state ERGODOME_OPENXR_TEST='log=log.txt;" +
                              script + "'");
  }

  //! Returns the lines of the runtime's log.
  [[nodiscard]] std::vector<json> log() const {
    std::vector<json> lines;
    std::ifstream stream(folder_ / "log.txt");
    for (std::string line; std::getline(stream, line);) {
      lines.push_back(json::parse(line));
    }
    return lines;
  }

  //! Returns the lines that have a key.
  [[nodiscard]] std::vector<json> lines_with(const char* key) const {
    std::vector<json> found;
    std::ranges::copy_if(log(), std::back_inserter(found), [&](const json& line) { return line.contains(key); });
    return found;
  }

  [[nodiscard]] std::string validation() const {
    std::ifstream stream(folder_ / "validation.txt");
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  //! Renders the view of an eye with a ray for each pixel. `front`: the room's direction in which
  //! the hole is [rad].
  [[nodiscard]] Luminance direct_view(ShowRenderer& renderer, int eye, std::int64_t time_ns, double front) const {
    const xr::Pose pose = xr::compose(xr::head_in_stage(time_ns), xr::eye_in_head(eye, 0.064));
    const xr::FieldOfView field = xr::field_of_view(eye, time_ns);
    CameraPose camera = camera_pose(renderer.show(), 0.0);
    camera.orientation =
        key_orientation(CameraKey()) * glm::angleAxis(-front, glm::dvec3(0.0, 1.0, 0.0)) * quaternion(pose.rotation);
    const Projection projection = make_frustum_projection(
        320, 352, {std::tan(field.left), std::tan(field.right), std::tan(field.up), std::tan(field.down)});
    Picture picture = renderer.render_eye(camera, 0.0, projection, ViewMode::sky, {0.0});
    picture.tone = renderer.tone();
    return luminance_of(320, 352, tone_mapped(picture).data());
  }
};

TEST_F(HeadsetOutput, PicturesAreThoseOfDirectRaysForEachEyeAndTime) {
  ASSERT_EQ(play("frames=500;pictures=pictures;every=50", "--size 480"), 0) << output_;
  EXPECT_EQ(lines_with("violation"), std::vector<json>{});
  EXPECT_EQ(validation(), "");
  const std::vector<json> frames = lines_with("display_time_ns");
  ASSERT_GE(frames.size(), 500U);
  const double front = heading_at(frames.front().at("display_time_ns").get<std::int64_t>());
  ShowRenderer renderer(read_show((folder_ / "show.toml").string()), Backend::cpu, LensChoice::direct);
  int compared = 0;
  for (const json& frame : frames) {
    const auto number = frame.at("frame").get<int>();
    // The first pictures are coarse, until the sky of the position has its final resolution.
    if (number < 400) {
      continue;
    }
    for (const int eye : {0, 1}) {
      char name[64];
      std::snprintf(name, sizeof name, "pictures/frame-%05d-%s.ppm", number, eye == 0 ? "left" : "right");
      if (!std::filesystem::exists(folder_ / name)) {
        continue;
      }
      ++compared;
      const std::vector<double> found =
          shifts(read_picture(folder_ / name),
                 direct_view(renderer, eye, frame.at("display_time_ns").get<std::int64_t>(), front));
      ASSERT_GE(found.size(), 10U) << name;
      EXPECT_LT(at_part(found, 0.5), 0.1) << name;
      EXPECT_LT(found.back(), 0.25) << name;
    }
  }
  EXPECT_GE(compared, 6);
}

TEST_F(HeadsetOutput, StarsAreWhereDirectRaysSeeThem) {
  write("stars.toml",
        standing_with("map = \"clouds.ppm\"", "map = \"black\"\nstars = \"bright_stars\"\nfaintest_mag = 5"));
  ASSERT_EQ(play("frames=120;pictures=pictures;every=20", "", "stars.toml"), 0) << output_;
  const std::vector<json> frames = lines_with("display_time_ns");
  const double front = heading_at(frames.front().at("display_time_ns").get<std::int64_t>());
  ShowRenderer renderer(read_show((folder_ / "stars.toml").string()), Backend::cpu, LensChoice::direct);
  int compared = 0;
  for (const json& frame : frames) {
    const auto number = frame.at("frame").get<int>();
    char name[64];
    std::snprintf(name, sizeof name, "pictures/frame-%05d-right.ppm", number);
    if (number < 80 || !std::filesystem::exists(folder_ / name)) {
      continue;
    }
    ++compared;
    const Luminance shown = read_picture(folder_ / name);
    const Luminance expected = direct_view(renderer, 1, frame.at("display_time_ns").get<std::int64_t>(), front);
    double light = 0.0;
    double difference = 0.0;
    for (std::size_t i = 0; i < shown.values.size(); ++i) {
      light += expected.values[i];
      difference += std::abs(shown.values[i] - expected.values[i]);
    }
    EXPECT_GT(light, 1000.0) << name;
    EXPECT_LT(difference, 0.02 * light) << name;
  }
  EXPECT_GE(compared, 2);
}

TEST_F(HeadsetOutput, EveryFrameThatIsWantedShowsPictures) {
  // The runtime checks that each has the poses of its own display time. New positions take much
  // longer than a frame.
  write("moving.toml", std::string("duration_s = 10\n") + standing + R"(
[[camera.key]]
t_s = 10
r = 8
theta_deg = 80
phi_deg = 90
)");
  ASSERT_EQ(play("frames=300", "", "moving.toml"), 0) << output_;
  int with_layers = 0;
  for (const json& frame : lines_with("display_time_ns")) {
    with_layers += frame.at("layers").empty() ? 0 : 1;
  }
  // All but the first two, in which the runtime wants nothing.
  EXPECT_EQ(with_layers, 298);
  EXPECT_EQ(lines_with("violation"), std::vector<json>{});
}

TEST_F(HeadsetOutput, TurningTheHeadNeedsNoNewLensAndNoNewStars) {
  Show show = read_show((folder_ / "show.toml").string());
  show.view.projection = ViewProjection::cube;
  show.view.cube_files = CubeFiles::strip;
  show.stereo.layout = StereoLayout::separate;
  show.stereo.model = StereoModel::flat;
  show.sky.stars = "bright_stars";
  show.sky.faintest_mag = 5.0;
  PictureRequest request;
  request.output.star_pixel = 1e-3;
  request.renderer = std::make_shared<ShowRenderer>(show, Backend::cpu, LensChoice::live);
  request.frame.pose = camera_pose(show, 0.0);
  request.frame.stereo = show.stereo;
  request.frame.stereo.baseline = 0.05;
  request.size_px = 6 * 128;
  request.patience_s = 60.0;
  ViewerHead& head = request.output.head.emplace();
  static_cast<void>(render_for_output(request));
  const auto before = work_done();
  for (int i = 1; i <= 6; ++i) {
    head.turn = glm::angleAxis(0.3 * i, glm::dvec3(0.0, 1.0, 0.0));
    EXPECT_EQ(render_for_output(request).turn, head.turn);
  }
  EXPECT_FALSE(work_between(before, work_done()).contains("trace_nodes"));
  EXPECT_FALSE(work_between(before, work_done()).contains("search_patches"));
  // A step of half a meter does need one.
  request.scale_per_m = 1.0;
  head.offset_m = {0.0, 0.0, 0.5};
  static_cast<void>(render_for_output(request));
  EXPECT_TRUE(work_between(before, work_done()).contains("trace_nodes"));
}

//! A way in which a runtime misbehaves, and the number of frames that show pictures in a run of 90.
struct HostileRun {
  const char* mode;
  int least_with_layers;  //!< minimum number of frames that show pictures
  int most_with_layers;
};

std::ostream& operator<<(std::ostream& out, const HostileRun& run) { return out << run.mode; }

class HeadsetOutputInRuntime : public HeadsetOutput, public testing::WithParamInterface<HostileRun> {};

TEST_P(HeadsetOutputInRuntime, ShowsFramesAndEndsWell) {
  const HostileRun& run = GetParam();
  ASSERT_EQ(play(std::string("frames=90;modes=") + run.mode), 0) << output_;
  EXPECT_EQ(lines_with("violation"), std::vector<json>{});
  EXPECT_EQ(validation(), "");
  const std::vector<json> summaries = lines_with("summary");
  ASSERT_FALSE(summaries.empty());
  const json& summary = summaries.back().at("summary");
  EXPECT_GE(summary.at("frames_with_layers").get<int>(), run.least_with_layers);
  EXPECT_LE(summary.at("frames_with_layers").get<int>(), run.most_with_layers);
  EXPECT_EQ(summary.at("foreign_contexts").get<int>(), 0);
}

INSTANTIATE_TEST_SUITE_P(Hostile, HeadsetOutputInRuntime,
                         testing::Values(HostileRun{"changes_context", 88, 88}, HostileRun{"gl_error", 88, 88},
                                         HostileRun{"one_format", 88, 88}, HostileRun{"linear_only", 88, 88},
                                         HostileRun{"no_layers", 88, 88}, HostileRun{"no_stage", 88, 88},
                                         HostileRun{"time_jumps", 88, 88}, HostileRun{"tiny", 88, 88},
                                         HostileRun{"recenter", 88, 88}, HostileRun{"quad", 88, 88},
                                         HostileRun{"focus_lost", 88, 88}, HostileRun{"slow_wait", 88, 88},
                                         HostileRun{"not_focused_first", 88, 88},
                                         // Without poses and while the headset is not worn, nothing is shown.
                                         HostileRun{"invalid_poses", 60, 70}, HostileRun{"taken_off", 50, 60},
                                         HostileRun{"restart", 80, 88}, HostileRun{"exit", 20, 30}),
                         [](const auto& run) { return std::string(run.param.mode); });

TEST_F(HeadsetOutput, EyesOfFourThousandPixelsAreDrawn) {
  // A picture takes seconds on a CPU, so there are few.
  ASSERT_EQ(play("frames=5;modes=huge", "--size 256"), 0) << output_;
  EXPECT_EQ(lines_with("violation"), std::vector<json>{});
  const std::vector<json> swapchains = lines_with("swapchain");
  ASSERT_FALSE(swapchains.empty());
  EXPECT_EQ(swapchains.front().at("width"), 4000);
  EXPECT_EQ(lines_with("summary").back().at("summary").at("frames_with_layers"), 3);
}

TEST_F(HeadsetOutput, EveryRefreshRateGetsFramesForItsOwnDisplayTimes) {
  for (const int rate : {72, 120}) {
    std::filesystem::remove(folder_ / "log.txt");
    ASSERT_EQ(play("frames=90;rate=" + std::to_string(rate)), 0) << output_;
    EXPECT_EQ(lines_with("violation"), std::vector<json>{});
    const std::vector<json> frames = lines_with("display_time_ns");
    ASSERT_EQ(frames.size(), 90U);
    const auto time_ns = [&](std::size_t i) { return frames[i].at("display_time_ns").get<std::int64_t>(); };
    EXPECT_NEAR(static_cast<double>(time_ns(60) - time_ns(30)), 30e9 / rate, 1e6);
    EXPECT_EQ(lines_with("summary").back().at("summary").at("frames_with_layers"), 88);
  }
}

TEST_F(HeadsetOutput, ALostHeadsetIsFoundAgainWithinFiveSeconds) {
  for (const char* mode : {"session_lost", "instance_lost"}) {
    std::filesystem::remove(folder_ / "log.txt");
    ASSERT_EQ(play(std::string("modes=") + mode, "--for 6 --screenshot mirror.png"), 0) << mode << output_;
    int begun = 0;
    for (const json& line : lines_with("session")) {
      begun += line.at("session") == "begun" ? 1 : 0;
    }
    EXPECT_EQ(begun, 2) << mode;
    EXPECT_TRUE(std::filesystem::exists(folder_ / "mirror.png")) << mode;
  }
}

TEST_F(HeadsetOutput, WithoutAHeadsetOneMessageSaysWhatToDo) {
  EXPECT_EQ(play("modes=no_system"), 1);
  EXPECT_THAT(output_,
              testing::HasSubstr("ergodome: headset: no headset is connected; connect the headset and switch it on\n"));
  EXPECT_EQ(play("modes=mono"), 1);
  EXPECT_THAT(output_, testing::HasSubstr("does not show two eyes; connect a stereoscopic headset"));
  EXPECT_EQ(run_on_display("play show.toml --headset --backend cpu", "XR_RUNTIME_JSON=/no/runtime.json"), 1);
  EXPECT_EQ(output_,
            "ergodome: headset: no OpenXR runtime is active; start SteamVR, Monado or WiVRn, and make it the active "
            "OpenXR runtime\n");
}

TEST_F(HeadsetOutput, AnExhibitRunsInItsWindowUntilThereIsAHeadset) {
  ASSERT_EQ(play("modes=no_system_at_first", "--exhibit --attract show.toml --for 6"), 0) << output_;
  EXPECT_GE(lines_with("display_time_ns").size(), 30U);
  EXPECT_EQ(lines_with("violation"), std::vector<json>{});
}

TEST_F(HeadsetOutput, ADistanceBetweenTheEyesThatTheyCannotFuseIsReducedWithAWarning) {
  write("apart.toml", standing_with("\"mono\"\nscale = 1e-9", "\"physical\"\nscale = 40"));
  ASSERT_EQ(play("frames=60", "", "apart.toml"), 0) << output_;
  EXPECT_THAT(output_, testing::HasSubstr("exceed stereo.comfort_deg (1°); the distance between the eyes is reduced"));
}

TEST_F(HeadsetOutput, WithoutTheOptionNoOpenXrLibraryIsLoaded) {
  ASSERT_EQ(run_on_display("play show.toml --backend cpu --no-sound --for 0.1", "LD_DEBUG=files"), 0);
  EXPECT_THAT(output_, testing::HasSubstr("libGL"));
  EXPECT_THAT(output_, testing::Not(testing::HasSubstr("openxr")));
}

}  // namespace ergodome::test
