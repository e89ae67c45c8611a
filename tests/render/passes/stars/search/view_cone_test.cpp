#include "render/passes/stars/search/view_cone.h"

#include <gtest/gtest.h>

#include "kernels/core/angles.h"
#include "tests/support/projections.h"

namespace ergodome {
namespace {

using test::NamedProjection;

//! Returns an eye for which the axes of the view are those of the observer's frame.
EyeCamera plain_eye() {
  EyeCamera eye{};
  for (int i = 0; i < 3; ++i) {
    eye.frame_from_view[i][i] = 1.0;
  }
  return eye;
}

class ViewCones : public testing::TestWithParam<NamedProjection> {};

TEST_P(ViewCones, HoldWhatThePictureShows) {
  const Projection& p = GetParam().projection;
  const ViewCone cone = view_cone(plain_eye(), p, 0.01);
  for (const auto& [x, y] : test::image_positions(p, 0.0)) {
    EXPECT_TRUE(may_touch(cone, direction_from_pixel(p, x, y), 0.0)) << x << " " << y;
  }
}

INSTANTIATE_TEST_SUITE_P(Each, ViewCones, testing::ValuesIn(test::every_projection()),
                         [](const auto& each) { return each.param.name; });

TEST(ViewCone, OfALensIsItsField) {
  EXPECT_EQ(view_cone(plain_eye(), test::lens_of(LensLaw::equisolid, 150.0), 0.0).half_angle, 75.0 * pi / 180.0);
}

TEST(ViewCone, OfASquareScreenReachesItsCorners) {
  const ViewCone cone = view_cone(plain_eye(), make_pinhole_projection(100, 100, pi / 2), 0.0);
  EXPECT_NEAR(cone.half_angle, std::atan(std::sqrt(2.0)), 0.02);
  EXPECT_GE(cone.half_angle, std::atan(std::sqrt(2.0)));
}

TEST(ViewCone, OfAFaceOfACubeIsNotTheWholeSky) {
  const ViewCone cone = view_cone(plain_eye(), make_cube_face_projection(100, CubeFace::right), 0.0);
  EXPECT_NEAR(cone.axis.x, 1.0, 1e-12);
  EXPECT_LT(cone.half_angle, 1.0);
}

}  // namespace
}  // namespace ergodome
