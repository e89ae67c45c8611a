#include "render/present/headset/star_view.h"

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "content/show/reading/show_reader.h"
#include "kernels/core/error.h"
#include "kernels/projection/make_projection.h"
#include "render/frame/show_renderer.h"
#include "render/opengl/headless_context.h"
#include "tests/support/gl_driver.h"

// Stars that a headset's views draw over a panorama, compared with pictures of the same views.

namespace ergodome {
namespace {

constexpr ImageSize view_size = {256, 224};
constexpr FrustumSides view_sides = {-0.9, 0.7, 0.8, -0.6};
constexpr int face_px = 192;

constexpr const char* stars_alone = R"(
[hole]
spin = 0.9
[[camera.key]]
r = 14
theta_deg = 75
[sky]
map = "black"
stars = "bright_stars"
faintest_mag = 6
[view]
projection = "cube"
cube_layout = "strip"
)";

constexpr const char* disk = R"(
[disk]
inner = 3
outer = 9
opacity = 0.8
)";

//! Renders a show's pictures at a pose: those of a panorama if `projection` is a cube.
std::vector<Picture> pictures(ShowRenderer& renderer, CameraPose pose, const glm::dquat& turn,
                              const Projection& projection) {
  pose.orientation = pose.orientation * turn;
  return renderer.render_window_parts(pose, projection, ViewMode::sky, {0.0});
}

class StarsOfAView : public testing::Test {
 protected:
  void SetUp() override {
    try {
      test::driver_was_loaded = true;
      context_ = std::make_unique<HeadlessContext>();
    } catch (const Error& problem) {
      GTEST_SKIP() << problem.what();
    }
  }

  //! Returns the luminance of the stars in a picture: its difference to one without stars.
  static std::vector<double> stars_of(const std::vector<float>& with, const std::vector<float>& without) {
    std::vector<double> stars;
    for (std::size_t i = 0; i < with.size(); i += 4) {
      stars.push_back(static_cast<double>(with[i + 1]) - static_cast<double>(without[i + 1]));
    }
    return stars;
  }

  //! Returns a view of a panorama, top row first. `turn`: rotates the view's axes into those of the
  //! pictures.
  static std::vector<float> view_of(const OutputFrame& frame, int eye, const glm::dquat& turn) {
    Panorama panorama;
    panorama.set(frame);
    StarView view;
    const glm::vec4 tangents(view_sides.left, view_sides.right, view_sides.down, view_sides.up);
    const unsigned texture = view.draw(panorama, eye, glm::mat3(glm::mat3_cast(turn)), tangents, view_size);
    std::vector<float> rows(static_cast<std::size_t>(4 * view_size.width * view_size.height));
    glGetTextureImage(texture, 0, GL_RGBA, GL_FLOAT, static_cast<GLsizei>(rows.size() * sizeof(float)), rows.data());
    constexpr std::ptrdiff_t row_floats = 4L * view_size.width;
    std::vector<float> picture;
    for (std::ptrdiff_t row = view_size.height - 1; row >= 0; --row) {
      picture.insert(picture.end(), rows.begin() + row * row_floats, rows.begin() + (row + 1) * row_floats);
    }
    return picture;
  }

  struct Compared {
    double light = 0.0;       //!< sum of the stars' light in the direct picture
    double difference = 0.0;  //!< sum of the differences' absolute values over `light`
  };

  //! Compares the stars of an eye's view, whose axes are turned against the panorama, with those of
  //! its own picture.
  static Compared compare(const Show& show, int eye, const glm::dquat& turn) {
    const Projection projection = make_frustum_projection(view_size.width, view_size.height, view_sides);
    Show starless = show;
    starless.sky.stars.clear();
    const CameraPose pose = camera_pose(show, 0.0);
    ShowRenderer renderer(show, Backend::cpu, LensChoice::direct);
    ShowRenderer without(starless, Backend::cpu, LensChoice::direct);
    const auto number = static_cast<std::size_t>(eye);
    const auto own = [&](ShowRenderer& from) {
      const std::vector<Picture> eyes = pictures(from, pose, turn, projection);
      const Picture& picture = eyes[eyes.size() > 1 ? number : 0];
      return std::vector<float>(picture.rgba.begin(), picture.rgba.end());
    };
    const std::vector<double> expected = stars_of(own(renderer), own(without));

    renderer.set_stars_apart(2.0 / view_size.width);
    std::vector<Picture> eyes =
        pictures(renderer, pose, glm::dquat(1.0, 0.0, 0.0, 0.0), make_projection(show.view, 6 * face_px, 0.0));
    OutputFrame frame;
    frame.picture = std::move(eyes.front());
    if (eyes.size() > 1) {
      frame.right_eye = std::move(eyes.back());
    }
    const std::vector<float> with_stars = view_of(frame, eye, turn);
    StarLights dark = *frame.picture.stars;
    dark.stars = {{{0.0F, 0.0F, -1.0F}, {0.0F, 0.0F, 0.0F}}};
    frame.picture.stars = std::make_shared<const StarLights>(dark);
    if (frame.right_eye) {
      frame.right_eye->stars = frame.picture.stars;
    }
    const std::vector<double> shown = stars_of(with_stars, view_of(frame, eye, turn));
    Compared compared;
    for (std::size_t i = 0; i < shown.size(); ++i) {
      compared.light += expected[i];
      compared.difference += std::abs(shown[i] - expected[i]);
    }
    compared.difference /= compared.light;
    return compared;
  }

  std::unique_ptr<HeadlessContext> context_;
};

TEST_F(StarsOfAView, AreThoseOfThePictureOfThatView) {
  const Show show = parse_show(stars_alone, "stars.toml");
  for (const double angle : {0.0, 0.4, -1.7}) {
    const glm::dquat turn = glm::angleAxis(angle, glm::normalize(glm::dvec3(0.3, 1.0, 0.2)));
    const Compared compared = compare(show, 0, turn);
    EXPECT_GT(compared.light, 1.0);
    EXPECT_LT(compared.difference, 0.002) << angle;
  }
}

TEST_F(StarsOfAView, AreHiddenByTheDiskBeforeThem) {
  const Compared before = compare(parse_show(stars_alone, "stars.toml"), 0, {1.0, 0.0, 0.0, 0.0});
  const Compared behind = compare(parse_show(std::string(stars_alone) + disk, "disk.toml"), 0, {1.0, 0.0, 0.0, 0.0});
  EXPECT_LT(behind.light, 0.9 * before.light);
  // The disk's opacity is interpolated between pixels of the panorama.
  EXPECT_LT(behind.difference, 0.03);
}

TEST_F(StarsOfAView, AreEachEyesOwnInEveryStereoModel) {
  for (const char* model : {"flat", "physical"}) {
    const Show show = parse_show(std::string(stars_alone) + disk + "[stereo]\nlayout = \"separate\"\nbaseline = 1\n" +
                                     "model = \"" + model + "\"\n",
                                 "stereo.toml");
    for (const int eye : {0, 1}) {
      EXPECT_LT(compare(show, eye, {1.0, 0.0, 0.0, 0.0}).difference, 0.03) << model << eye;
    }
  }
}

TEST_F(StarsOfAView, StayInThePictureIfBloomSpreadsTheirLight) {
  ShowRenderer renderer(parse_show(std::string(stars_alone) + "[effects.bloom]\nstrength = 0.1\n", "bloom.toml"),
                        Backend::cpu);
  renderer.set_stars_apart(0.01);
  const Projection projection = make_projection(renderer.show().view, 6 * 64, 0.0);
  const Picture picture = renderer.render_window(camera_pose(renderer.show(), 0.0), projection, ViewMode::sky, {0.0});
  EXPECT_EQ(picture.stars, nullptr);
  double light = 0.0;
  for (std::size_t i = 0; i < picture.rgba.size(); i += 4) {
    light += static_cast<double>(picture.rgba[i + 1]);
  }
  EXPECT_GT(light, 1.0);
}

}  // namespace
}  // namespace ergodome
