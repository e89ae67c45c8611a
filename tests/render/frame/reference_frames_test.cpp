#include "tests/support/reference_frames.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <memory>

#include "content/show/reading/show_reader.h"
#include "kernels/core/error.h"
#include "render/frame/show_renderer.h"
#include "render/opengl/headless_context.h"
#include "render/patterns/test_pattern.h"
#include "render/present/presenter.h"
#include "render/present/projectors/headless_projectors.h"
#include "tests/support/folder_test.h"
#include "tests/support/gl_driver.h"
#include "tests/support/simulated_dome.h"

// Hook of LeakSanitizer: disables its reports if a test loaded an OpenGL driver (gl_driver.h).
// NOLINTNEXTLINE: LeakSanitizer prescribes the name
extern "C" int __lsan_is_turned_off() { return ergodome::test::driver_was_loaded ? 1 : 0; }

// Compares frames for windows and projectors, drawn through EGL, with reference frames that a
// person has checked.
namespace ergodome {
namespace {

using test::SeenFrame;

//! Compares a frame with the reference frame `name`.
void expect_like(const std::string& name, const SeenFrame& frame) {
  test::expect_like_reference(std::filesystem::path(ERGODOME_TEST_DATA_DIR) / "frames" / (name + ".png"), frame);
}

//! Returns a picture as a window of the same size would display it; nothing if there is no OpenGL
//! driver.
std::optional<SeenFrame> seen_in_a_window(const Picture& picture) {
  try {
    test::driver_was_loaded = true;
    const HeadlessContext context;
    const OffscreenFrame frame(picture.width, picture.height);
    Presenter presenter;
    presenter.upload(picture);
    frame.bind();
    presenter.draw(frame.width(), frame.height());
    return SeenFrame{frame.width(), frame.height(), frame.read_back()};
  } catch (const Error&) {
    return std::nullopt;
  }
}

class FramesOfASky : public test::FolderTest {
 protected:
  //! Writes a small sky map that consists of fields in four colors, with lines between them.
  //! Returns its path.
  [[nodiscard]] std::string sky_map() const {
    constexpr int width = 128;
    constexpr int height = 64;
    std::vector<std::uint8_t> rgb;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const bool line = x % 16 < 2 || y % 16 < 2;
        const auto level = [&](int bit) {
          return static_cast<std::uint8_t>(line ? 200 : ((x / 16 + 2 * (y / 16)) >> bit) % 2 == 0 ? 40 : 140);
        };
        rgb.insert(rgb.end(), {level(0), level(1), level(2)});
      }
    }
    write_png(folder_ / "sky.png", rgb, width, height);
    return (folder_ / "sky.png").string();
  }
};

//! Tests each stereo layout by its name in shows. For a new layout, add its name and renew the
//! reference frames.
class LayoutFrames : public FramesOfASky, public testing::WithParamInterface<const char*> {};

TEST_P(LayoutFrames, AreAsTheyWereLookedAt) {
  const std::string layout = GetParam();
  ShowRenderer renderer(
      parse_show("[hole]\nspin = 0.999\n[camera]\n[[camera.key]]\nr = 6\n[sky]\nmap = \"" + sky_map() +
                     "\"\n"
                     "[view]\nprojection = \"dome\"\ntilt_deg = 45\nsize_px = 160\n"
                     "[stereo]\nlayout = \"" +
                     layout + "\"\nbaseline = 0.8\n",
                 "layouts.toml"),
      Backend::cpu, LensChoice::direct);
  const Projection projection = make_projection(renderer.show().view, 160, 0.0);
  const auto seen =
      seen_in_a_window(renderer.render_window(camera_pose(renderer.show(), 0.0), projection, ViewMode::sky));
  if (!seen) {
    GTEST_SKIP() << "no OpenGL driver";
  }
  expect_like("layout_" + layout, *seen);
}

INSTANTIATE_TEST_SUITE_P(Every, LayoutFrames,
                         testing::Values("mono", "side_by_side", "top_bottom", "separate", "anaglyph", "dubois", "rows",
                                         "half_side_by_side", "half_top_bottom"),
                         [](const auto& layout) { return std::string(layout.param); });

//! A picture with two captions of two lines, a flat image with a border, and a fisheye image of a
//! ring around everything.
class OverlayFrames : public FramesOfASky {
 protected:
  [[nodiscard]] Timeline timeline() const {
    write_picture(folder_ / "ring.png", {ImageFormat::png, ExrCompression::zip, true}, ring(), {});
    Timeline timeline;
    const Presence always = {-1.0, 1e3, 0.0, 0.0};
    Overlay image;
    image.image = "sky.png";
    image.presence = always;
    image.position = {-60.0, 40.0, 0.0};
    image.width_deg = 40.0;
    Overlay fisheye;
    fisheye.image = "ring.png";
    fisheye.presence = always;
    fisheye.fisheye = true;
    timeline.overlays = {fisheye, image};
    Caption words;
    words.presence = always;
    words.letter_deg = 5.0;
    words.width_deg = 80.0;
    words.position = {0.0, 12.0, 0.0};
    words.text = {{"en", "Nothing that falls in comes out again: the shadow"}};
    timeline.captions.push_back(words);
    words.position = {180.0, 12.0, 0.0};
    words.color = {1.0, 0.7, 0.2};
    words.text = {{"en", "Was hineinfällt, kommt nicht wieder heraus: größer"}};
    timeline.captions.push_back(words);
    return timeline;
  }

 private:
  //! Returns a domemaster with a ring between 40 and 45 degrees from the zenith.
  static Picture ring() {
    constexpr int size = 256;
    Picture picture;
    picture.width = picture.height = size;
    picture.tone = {ToneCurve::gamma, 1.0F, 1.0F, 1.0F};
    for (int i = 0; i < size * size; ++i) {
      const int row = i / size;
      const double zenith_deg = 90.0 * std::hypot(i % size + 0.5 - 128.0, row + 0.5 - 128.0) / 128.0;
      const float alpha = zenith_deg > 40.0 && zenith_deg < 45.0 ? 0.7F : 0.0F;
      picture.rgba.insert(picture.rgba.end(), {0.1F * alpha, 0.9F * alpha, alpha, alpha});
    }
    return picture;
  }
};

TEST_F(OverlayFrames, AreAsTheyWereLookedAt) {
  Show show = parse_show("[hole]\nspin = 0.999\n[camera]\n[[camera.key]]\nr = 6\n[sky]\nmap = \"" + sky_map() +
                             "\"\n[view]\nprojection = \"dome\"\ntilt_deg = 30\nsize_px = 512\n",
                         (folder_ / "overlays.toml").string());
  show.timeline = timeline();
  ShowRenderer renderer(show, Backend::cpu, LensChoice::direct);
  const auto seen = seen_in_a_window(renderer.render(0.5, {}).front().picture);
  if (!seen) {
    GTEST_SKIP() << "no OpenGL driver";
  }
  expect_like("overlays", *seen);
}

class PatternFrames : public testing::TestWithParam<std::string> {};

TEST_P(PatternFrames, AreAsTheyWereLookedAt) {
  ViewSettings view;
  view.tilt_deg = 20.0;
  const auto seen = seen_in_a_window(draw_test_pattern(test_pattern(GetParam()), make_projection(view, 320, 0.0)));
  if (!seen) {
    GTEST_SKIP() << "no OpenGL driver";
  }
  expect_like("pattern_" + GetParam(), *seen);
}

INSTANTIATE_TEST_SUITE_P(Every, PatternFrames, testing::ValuesIn(test_pattern_names()),
                         [](const auto& pattern) { return pattern.param; });

TEST(NumberFrame, IsAsItWasLookedAt) {
  const auto seen = seen_in_a_window(draw_projector_number(3, "south east", 320, 200));
  if (!seen) {
    GTEST_SKIP() << "no OpenGL driver";
  }
  expect_like("projector_number", *seen);
}

//! Draws a pattern on each of the three projectors of a dome, by OpenGL and by the CPU.
class ProjectorReferences : public testing::TestWithParam<ProjectorDrawer> {};

TEST_P(ProjectorReferences, AreAsTheyWereLookedAt) {
  DomeSetup setup = test::three(320);
  setup.projectors[2].black_level_lift = {0.02, 0.02, 0.02};
  setup.projectors[1].gain = {1.0, 0.8, 0.6};
  ViewSettings view;
  view.tilt_deg = setup.tilt_deg;
  const Picture master = draw_test_pattern(TestPattern::orientation, make_projection(view, 512, 0.0));
  std::unique_ptr<HeadlessProjectors> projectors;
  try {
    test::driver_was_loaded = test::driver_was_loaded || GetParam() == ProjectorDrawer::opengl;
    projectors = std::make_unique<HeadlessProjectors>(projector_pictures(setup), GetParam());
  } catch (const Error& problem) {
    GTEST_SKIP() << problem.what();
  }
  projectors->show(master);
  SeenFrame row{320, 600, {}};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto frame = projectors->frame(i);
    row.rgb.insert(row.rgb.end(), frame.begin(), frame.end());
  }
  expect_like("projectors", row);
}

INSTANTIATE_TEST_SUITE_P(By, ProjectorReferences, testing::Values(ProjectorDrawer::opengl, ProjectorDrawer::processor),
                         [](const auto& drawer) {
                           return drawer.param == ProjectorDrawer::opengl ? "opengl" : "processor";
                         });

}  // namespace
}  // namespace ergodome
