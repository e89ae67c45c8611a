#include <gtest/gtest.h>

#include <string>

#include "render/frame/show_renderer.h"
#include "tests/render/accuracy/accuracy_scene.h"

namespace ergodome {
namespace {

std::string lens_name(ShowRenderer& renderer) {
  const CameraPose pose = camera_pose(renderer.show(), 0.0);
  return renderer.lens_of(pose, make_projection(renderer.show().view, 48, 0.0))->name();
}

Picture picture_of(ShowRenderer& renderer) {
  const CameraPose pose = camera_pose(renderer.show(), 0.0);
  return renderer.render_eye(pose, 0.0, make_projection(renderer.show().view, 48, 0.0), ViewMode::sky);
}

TEST(FrameQuality, ChangesTheLensOfTheNextPicture) {
  ShowRenderer renderer(test::small_dome(), Backend::cpu, LensChoice::direct);
  EXPECT_EQ(lens_name(renderer), "direct");
  renderer.set_quality({0.25, LensChoice::live, SkyFilter::ewa});
  EXPECT_EQ(lens_name(renderer), "live");
  EXPECT_STREQ(picture_of(renderer).lens, "live");
}

TEST(FrameQuality, GivesThePictureOfAShowThatAsksForIt) {
  Show show = test::small_dome();
  ShowRenderer changed(show, Backend::cpu);
  changed.set_quality({1.0, LensChoice::live, SkyFilter::point});
  show.quality.budget_px = 1.0;
  show.sky.filter = SkyFilter::point;
  ShowRenderer asked(show, Backend::cpu, LensChoice::live);
  EXPECT_EQ(picture_of(changed).rgba, picture_of(asked).rgba);
  EXPECT_EQ(changed.quality(), asked.quality());
}

TEST(FrameQuality, LeavesAFilterByPolygonsAlone) {
  Show show = test::small_dome();
  show.sky.filter = SkyFilter::polygon;
  ShowRenderer renderer(show, Backend::cpu);
  renderer.set_quality({1.0, LensChoice::live, SkyFilter::point});
  EXPECT_EQ(renderer.quality().filter, SkyFilter::polygon);
  EXPECT_EQ(renderer.quality().budget_px, 1.0);
}

}  // namespace
}  // namespace ergodome
