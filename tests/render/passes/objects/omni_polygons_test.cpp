#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "content/show/reading/show_reader.h"
#include "render/frame/show_renderer.h"
#include "render/passes/objects/polygons/omni_view.h"
#include "tests/render/passes/objects/object_scene.h"
#include "tests/support/errors.h"
#include "tests/support/sanitized.h"

// Tests of polygons in omnidirectional stereo. They are compared with objects drawn by rays, for
// which each pixel has its own camera.
namespace ergodome {
namespace {

//! A white ball in front of a black sky, and the camera and eyes of the model `omni` that see it.
struct BallBeforeEyes {
  const char* name;
  const char* position;  //!< position of the ball
  const char* view = "projection = \"dome\"\nsize_px = 400\n";
  const char* stereo = "baseline = 0.4\n";
  const char* observer = "static";
};

Show ball_show(const BallBeforeEyes& at, const std::string& method) {
  return parse_show(
      "[hole]\nspin = 0\n[camera]\nobserver = \"" + std::string(at.observer) +
          "\"\n[[camera.key]]\nr = 15\ntheta_deg = 75\nphi_deg = 20\npitch_deg = 10\n[sky]\nmap = \"black\"\n"
          "[[objects]]\nmethod = \"" +
          method +
          "\"\nshape = \"sphere\"\nsegments = 48\nrings = 24\nsize = 0.6\ntessellation = { most = 8 }\nposition = [" +
          at.position + "]\n[view]\n" + at.view + "[stereo]\nmodel = \"omni\"\nlayout = \"separate\"\n" + at.stereo,
      "test.toml");
}

//! The center of the light in a picture [px], and its amount.
struct Blob {
  double x = 0.0;
  double y = 0.0;
  double light = 0.0;
};

//! Returns the center and the amount of the light within `within_px` of a position.
Blob blob_about(const Blob& position, double within_px, const Picture& picture) {
  Blob blob;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const auto at =
          4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) + static_cast<std::size_t>(x));
      const bool counts = std::hypot(x + 0.5 - position.x, y + 0.5 - position.y) < within_px;
      const double value = counts ? static_cast<double>(picture.rgba[at]) : 0.0;
      blob.light += value;
      blob.x += (x + 0.5) * value;
      blob.y += (y + 0.5) * value;
    }
  }
  blob.x /= blob.light;
  blob.y /= blob.light;
  return blob;
}

//! Returns the center of the light of the ball's first image. Other images are left out: the second
//! one is a sliver on the other side of the hole, whose few pixels would have a large effect; a
//! third one, next to the shadow's edge, is drawn only by rays.
Blob blob_of(const Picture& picture) { return blob_about(blob_about({}, 1e6, picture), 35.0, picture); }

std::array<Blob, 2> eyes_of(const BallBeforeEyes& at, const std::string& method) {
  const Show show = ball_show(at, method);
  ShowRenderer renderer(show, Backend::cpu);
  const auto parts = renderer.render_window_parts(camera_pose(show, 0.0),
                                                  make_projection(show.view, show.view.size_px, 0.0), ViewMode::sky);
  EXPECT_EQ(parts.size(), 2U);
  return {blob_of(parts.front()), blob_of(parts.back())};
}

class OmniPolygons : public test::ObjectScenes {};

TEST_F(OmniPolygons, AreWhereRaysOfEachPixelsOwnCameraMeetThem) {
  constexpr const char* wide = "projection = \"pinhole\"\nfov_deg = 90\nsize_px = 400\n";
  const auto all = std::vector<BallBeforeEyes>{
      {"beside the hole", "2, 6, 4", wide},
      {"beside the hole, with convergence", "2, 6, 4", wide, "baseline = 0.4\nconvergence = 12\n"},
      {"behind the hole", "-8, 3, -2", wide},
      {"near, from a moving camera", "10, 5.5, 4.2", "projection = \"dome\"\nfov_deg = 220\nsize_px = 400\n",
       "baseline = 0.4\n", "geodesic"},
      {"to the right on a panorama", "9, 9, 6", "projection = \"equirect\"\nsize_px = 600\n"},
      {"in a cube", "9, 9, 6", "projection = \"cube\"\nsize_px = 600\n"},
      {"from eyes far apart", "10, 5.5, 4.2", wide, "baseline = 2\n"}};
  // Under sanitizers, every third case is enough to cover the same code.
  for (std::size_t i = 0; i < all.size(); i += test::sanitized ? 3 : 1) {
    const BallBeforeEyes& at = all[i];
    SCOPED_TRACE(at.name);
    const auto drawn = eyes_of(at, "polygon");
    const auto traced = eyes_of(at, "trace");
    for (std::size_t eye = 0; eye < 2; ++eye) {
      ASSERT_GT(traced[eye].light, 30.0);
      EXPECT_NEAR(drawn[eye].light / traced[eye].light, 1.0, 0.02);
      EXPECT_NEAR(drawn[eye].x, traced[eye].x, 0.05) << eye;
      EXPECT_NEAR(drawn[eye].y, traced[eye].y, 0.05) << eye;
    }
    // Checks the test itself: if both eyes were at the position of the head, the comparison would
    // succeed, too.
    EXPECT_GT(std::hypot(drawn[0].x - drawn[1].x, drawn[0].y - drawn[1].y), 0.5);
  }
}

TEST_F(OmniPolygons, AreTheHeadsWithoutABaseline) {
  const BallBeforeEyes at = {"", "2, 6, 4", "projection = \"dome\"\nsize_px = 200\n", "baseline = 0\n"};
  const auto eyes = eyes_of(at, "polygon");
  EXPECT_EQ(eyes[0].x, eyes[1].x);
  EXPECT_EQ(eyes[0].y, eyes[1].y);
}

TEST_F(OmniPolygons, AreDrawnHoweverNearTheEyesAreToEachOther) {
  const BallBeforeEyes at = {"", "2, 6, 4", "projection = \"pinhole\"\nfov_deg = 90\nsize_px = 200\n"};
  BallBeforeEyes near = at;
  near.stereo = "baseline = 1e-7\n";
  BallBeforeEyes together = at;
  together.stereo = "baseline = 0\n";
  const auto eyes = eyes_of(near, "polygon");
  const auto one = eyes_of(together, "polygon");
  ASSERT_GT(one[0].light, 30.0);
  for (const Blob& eye : eyes) {
    EXPECT_NEAR(eye.x, one[0].x, 0.01);
    EXPECT_NEAR(eye.y, one[0].y, 0.01);
    EXPECT_NEAR(eye.light / one[0].light, 1.0, 0.01);
  }
}

TEST_F(OmniPolygons, AreNotSeenByEyesInsideThePhotonSphere) {
  Show show = ball_show(BallBeforeEyes{"", "2, 6, 4"}, "polygon");
  show.camera.keys[0].r = 3.5;
  show.stereo.baseline = 1.6;
  ShowRenderer renderer(show, Backend::cpu);
  const std::string message = test::error_of([&] {
    renderer.render_window_parts(camera_pose(show, 0.0), make_projection(show.view, 100, 0.0), ViewMode::sky);
  });
  EXPECT_NE(message.find("photon sphere"), std::string::npos) << message;
}

}  // namespace
}  // namespace ergodome
