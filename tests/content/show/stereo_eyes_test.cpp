#include "content/show/stereo_eyes.h"

#include <gtest/gtest.h>

namespace ergodome {
namespace {

TEST(StereoEyes, HaveACameraPerDirectionOnlyWithTwoEyes) {
  StereoSettings stereo;
  stereo.model = StereoModel::omni;
  EXPECT_FALSE(has_camera_per_direction(stereo));
  stereo.layout = StereoLayout::side_by_side;
  EXPECT_TRUE(has_camera_per_direction(stereo));
  stereo.model = StereoModel::flat;
  EXPECT_FALSE(has_camera_per_direction(stereo));
}

TEST(StereoEyes, ShareACameraOnlyAtDifferentPositions) {
  StereoSettings stereo;
  stereo.layout = StereoLayout::side_by_side;
  stereo.model = StereoModel::flat;
  EXPECT_FALSE(share_camera(stereo));
  stereo.baseline = 0.1;
  EXPECT_TRUE(share_camera(stereo));
  stereo.model = StereoModel::physical;
  EXPECT_FALSE(share_camera(stereo));
  EXPECT_EQ(eye_cameras(stereo.model), EyeCameras::own);
}

TEST(StereoEyes, FollowOneAnotherInARing) {
  StereoModel model = StereoModel::physical;
  for (std::size_t i = 0; i < stereo_model_names.size(); ++i) {
    model = next_model(model);
  }
  EXPECT_EQ(model, StereoModel::physical);
  EXPECT_EQ(next_model(model), StereoModel::flat);
}

TEST(StereoEyes, OfAFallAreThoseThatAreDefinedInside) {
  EXPECT_EQ(model_for_fall(StereoModel::flat), StereoModel::physical);
  EXPECT_EQ(model_for_fall(StereoModel::omni), StereoModel::omni);
  EXPECT_EQ(model_for_fall(StereoModel::physical), StereoModel::physical);
}

}  // namespace
}  // namespace ergodome
