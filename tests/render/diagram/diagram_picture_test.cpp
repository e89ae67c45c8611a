#include "render/diagram/diagram_picture.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "kernels/core/angles.h"
#include "kernels/core/error.h"
#include "render/diagram/diagram.h"
#include "tests/support/errors.h"
#include "tests/support/gl_driver.h"

// Hook of LeakSanitizer: disables its reports if a test loaded an OpenGL driver (gl_driver.h).
// NOLINTNEXTLINE: LeakSanitizer prescribes the name
extern "C" int __lsan_is_turned_off() { return ergodome::test::driver_was_loaded ? 1 : 0; }

// Tests of diagrams drawn as pictures.
namespace ergodome {
namespace {

using ::testing::HasSubstr;

//! Returns a show with a ball next to a hole and an observer on the x axis.
Show small_show(double spin) {
  Show show;
  show.name = "small";
  show.title = {{"", "A ball"}};
  show.duration_s = 10.0;
  show.spin = spin;
  show.camera.keys.resize(1);
  show.camera.keys[0].r = 25.0;
  show.view.projection = ViewProjection::pinhole;
  show.view.field_of_view_deg = 40.0;
  ObjectSettings ball;
  ball.form = ObjectForm::sphere;
  ball.method = spin == 0.0 ? ObjectMethod::polygon : ObjectMethod::trace;
  ball.position = {-6.0, 5.0, 1.0};
  show.objects = {ball};
  return show;
}

class DiagramPictures : public testing::Test {
 protected:
  void SetUp() override {
    test::driver_was_loaded = true;
    try {
      const GlThread thread;
    } catch (const Error& problem) {
      GTEST_SKIP() << problem.what();
    }
  }

  void draw(const Show& show, const DiagramSettings& settings, int width_px = 640) {
    scene_ = Diagram(show, settings).at(0.0);
    DiagramPicture picture(width_px, width_px * 9 / 16);
    camera_ = picture.camera_for({-1.1, 0.4, std::nullopt}, scene_.framed, scene_.legend.size());
    image_ = picture.draw(scene_, camera_);
  }

  //! Returns where a point of the scene is in the picture [px].
  [[nodiscard]] std::array<double, 2> pixel_of(const Vector3<double>& position) const {
    const Vector3<double> at = camera_.in_view(position);
    return {0.5 * (1.0 - at.x / (at.z * camera_.half_width)) * image_.width_px,
            0.5 * (1.0 + at.y / (at.z * camera_.half_height)) * image_.height_px};
  }

  [[nodiscard]] std::array<int, 3> color_at(int x, int y) const {
    const std::size_t i =
        3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image_.width_px) + static_cast<std::size_t>(x));
    return {image_.rgb[i], image_.rgb[i + 1], image_.rgb[i + 2]};
  }

  //! Returns the number of pixels whose display color is close to the given one.
  [[nodiscard]] int pixels_like(int red, int green, int blue) const {
    int count = 0;
    for (int y = 0; y < image_.height_px * 3 / 4; ++y) {
      for (int x = 0; x < image_.width_px; ++x) {
        const std::array<int, 3> c = color_at(x, y);
        count += std::abs(c[0] - red) + std::abs(c[1] - green) + std::abs(c[2] - blue) < 40 ? 1 : 0;
      }
    }
    return count;
  }

  DiagramScene scene_;
  OutsideCamera camera_{};
  DiagramImage image_{};
};

TEST_F(DiagramPictures, TheHoleIsBlackToItsHorizon) {
  // Removes rays, axes and labels, which would be drawn across the hole.
  draw(small_show(0.0), {{1}, 0});
  scene_.lines.clear();
  scene_.veils.clear();
  scene_.labels.clear();
  DiagramPicture picture(640, 360);
  image_ = picture.draw(scene_, camera_);
  const std::array<double, 2> middle = pixel_of({0.0, 0.0, 0.0});
  const std::vector<Vector3<double>> rim = sphere_outline(2.0, camera_);
  for (std::size_t i = 0; i < rim.size(); i += 15) {
    const std::array<double, 2> edge = pixel_of(rim[i]);
    for (const auto& [share, black] : {std::pair{0.5, true}, std::pair{0.8, true}, std::pair{1.25, false}}) {
      const int x = static_cast<int>(middle[0] + share * (edge[0] - middle[0]));
      const int y = static_cast<int>(middle[1] + share * (edge[1] - middle[1]));
      EXPECT_EQ(color_at(x, y) == (std::array{0, 0, 0}), black) << i << " " << share;
    }
  }
}

TEST_F(DiagramPictures, RaysHaveTheColourOfTheirImage) {
  draw(small_show(0.0), {{1}, 12});
  EXPECT_GT(pixels_like(0x00, 0x72, 0xB2), 100);
  EXPECT_EQ(pixels_like(0xD5, 0x5E, 0x00), 0);
  draw(small_show(0.0), {{2}, 12});
  EXPECT_EQ(pixels_like(0x00, 0x72, 0xB2), 0);
  EXPECT_GT(pixels_like(0xD5, 0x5E, 0x00), 100);
}

TEST_F(DiagramPictures, ASpinningHoleHasRaysThatMeetTheObjects) {
  draw(small_show(0.9), {{}, 18}, 1280);
  EXPECT_GT(pixels_like(0x00, 0x72, 0xB2), 100);
}

//! Counts the points of rays (lines in the colors of the images) that lie outside a picture which
//! is taller than wide, for a view from the given direction.
int positions_beside(const DiagramScene& scene, const OutsideDirection& from) {
  const OutsideCamera camera = outside_camera(from, scene.framed, 0.5, {});
  int beside = 0;
  for (const DiagramLine& line : scene.lines) {
    if (line.ink == diagram_inks::of_image(1) || line.ink == diagram_inks::of_image(2)) {
      beside += static_cast<int>(std::ranges::count_if(line.positions, [&](const Vector3<double>& position) {
        const Vector3<double> at = camera.in_view(position);
        return std::abs(at.x) > -at.z * camera.half_width || std::abs(at.y) > -at.z * camera.half_height;
      }));
    }
  }
  return beside;
}

TEST(DiagramFrames, HoldTheRaysThatMeetObjects) {
  for (const double spin : {0.0, 0.9}) {
    // The scene includes the rays of the second image, which pass the hole on the other side.
    const DiagramScene scene =
        Diagram(small_show(spin), {spin == 0.0 ? std::vector<int>{1, 2} : std::vector<int>{}, 60}).at(0.0);
    EXPECT_EQ(positions_beside(scene, {0.5, 0.5, std::nullopt}), 0) << spin;
    EXPECT_EQ(positions_beside(scene, {pi, 0.2, std::nullopt}), 0) << spin;
  }
}

TEST_F(DiagramPictures, TheCornersOfThePictureArePaper) {
  draw(small_show(0.0), {});
  for (const int x : {0, image_.width_px - 1}) {
    EXPECT_EQ(color_at(x, 0), (std::array{0xF7, 0xF6, 0xF3}));
  }
}

TEST_F(DiagramPictures, PicturesOfSeveralTilesHaveNoSeam) {
  draw(small_show(0.0), {{1, 2}, 12});
  const DiagramImage whole = image_;
  DiagramPicture large(2560, 1440);
  const DiagramImage fine = large.draw(scene_, camera_);
  // Except for the labels, the mean of 4 x 4 pixels of the large picture must equal a pixel of the
  // small picture.
  double sum = 0.0;
  for (int y = 0; y < 250; ++y) {
    for (int x = 0; x < whole.width_px; ++x) {
      for (std::size_t k = 0; k < 3; ++k) {
        double mean = 0.0;
        for (int i = 0; i < 16; ++i) {
          const long at = (4L * y + i / 4) * 2560 + 4L * x + i % 4;
          mean += fine.rgb[3 * static_cast<std::size_t>(at) + k] / 16.0;
        }
        sum += std::abs(mean - color_at(x, y)[k]);
      }
    }
  }
  EXPECT_LT(sum / (250.0 * whole.width_px * 3.0), 1.0);
}

TEST(Diagrams, DrawAboutAsManyRaysAsAskedFor) {
  EXPECT_EQ(Diagram(small_show(0.0), {{1, 2}, 30}).at(0.0).ray_count, 30);
  EXPECT_EQ(Diagram(small_show(0.0), {{1, 2}, 0}).at(0.0).ray_count, 0);
  EXPECT_NEAR(Diagram(small_show(0.9), {{}, 30}).at(0.0).ray_count, 30, 3);
}

TEST(Diagrams, HaveAnApparentMeshForEachImage) {
  const std::size_t one = Diagram(small_show(0.0), {{1}, 0}).at(0.0).veils.size();
  EXPECT_GT(one, 3U * 1000U);
  EXPECT_GT(Diagram(small_show(0.0), {{1, 2}, 0}).at(0.0).veils.size(), one);
}

TEST(Diagrams, RefuseWhatTheyCannotShow) {
  Show empty = small_show(0.0);
  empty.objects.clear();
  EXPECT_THAT(test::error_of([&] { Diagram(empty, {}); }), HasSubstr("has no objects"));
  EXPECT_THAT(test::error_of([&] { Diagram(small_show(0.5), {{1, 2}, 9}); }), HasSubstr("has a spinning hole"));
}

}  // namespace
}  // namespace ergodome
