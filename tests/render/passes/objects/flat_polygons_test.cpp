#include <gtest/gtest.h>

#include <utility>

#include "render/frame/show_renderer.h"
#include "tests/render/passes/objects/flat_ball.h"
#include "tests/render/passes/objects/object_scene.h"
#include "tests/support/sanitized.h"

// Tests of polygons, as eyes of the stereo model `flat` see them: what the head sees in direction n
// at the affine distance d is at the point d n.
namespace ergodome {
namespace {

class FlatPolygons : public test::ObjectScenes {};

TEST_F(FlatPolygons, AreWhereFlatSpacePutsThemForEachEye) {
  const auto balls = test::balls_before_heads();
  // Under sanitizers, every third ball is enough to cover the same code.
  for (std::size_t i = 0; i < balls.size(); i += test::sanitized ? 3 : 1) {
    test::expect_where_flat_space_puts(balls[i]);
  }
}

TEST_F(FlatPolygons, HideEachOtherAsTheyStandForEachEye) {
  // As seen from the head, a black ball hides a white one. An eye far to the side sees the white
  // ball.
  Show show =
      test::flat_ball({"", {8, 3, 2}, "static", "projection = \"pinhole\"\nfov_deg = 100\nsize_px = 300\n", 4.0});
  ObjectSettings black = show.objects[0];
  black.color = {0.0, 0.0, 0.0};
  black.position = {9.5, 3.6, 2.6};
  black.size = 0.3;
  show.objects.push_back(black);
  ShowRenderer renderer(show, Backend::cpu);
  const Projection projection = make_projection(show.view, 300, 0.0);
  const auto eyes = renderer.render_window_parts(camera_pose(show, 0.0), projection, ViewMode::sky);
  StereoSettings together = show.stereo;
  together.baseline = 0.0;
  renderer.set_stereo(together);
  const auto heads = renderer.render_window_parts(camera_pose(show, 0.0), projection, ViewMode::sky);
  const auto light = [](const Picture& picture) {
    double sum = 0.0;
    for (std::size_t i = 0; i < picture.rgba.size(); i += 4) {
      sum += static_cast<double>(picture.rgba[i]);
    }
    return sum;
  };
  // The head and both eyes see the second image of the white ball, next to the hole.
  EXPECT_GT(light(eyes[0]) + light(eyes[1]), 2.0 * light(heads[0]) + 5.0);
  Show swapped = show;
  std::swap(swapped.objects[0], swapped.objects[1]);
  const auto others =
      ShowRenderer(swapped, Backend::cpu).render_window_parts(camera_pose(show, 0.0), projection, ViewMode::sky);
  EXPECT_EQ(eyes[0].rgba, others[0].rgba);
  EXPECT_EQ(eyes[1].rgba, others[1].rgba);
}

TEST_F(FlatPolygons, AreTheHeadsWithoutABaseline) {
  const Show show = test::flat_ball({"", {2, 6, 4}, "static", "projection = \"dome\"\nsize_px = 200\n", 0.0});
  ShowRenderer renderer(show, Backend::cpu);
  const auto eyes =
      renderer.render_window_parts(camera_pose(show, 0.0), make_projection(show.view, 200, 0.0), ViewMode::sky);
  EXPECT_EQ(eyes[0].rgba, eyes[1].rgba);
}

}  // namespace
}  // namespace ergodome
