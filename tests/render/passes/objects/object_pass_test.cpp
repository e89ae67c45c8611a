#include <gmock/gmock.h>

#include <fstream>

#include "tests/render/passes/objects/object_scene.h"
#include "tests/support/errors.h"
#include "tests/support/folder_test.h"

// Tests of drawing objects: projections, depth, light, and scenes that are refused.
namespace ergodome {
namespace {

using test::closed_form_direction;
using test::eye_looking;
using test::small_sphere;

constexpr double pass_r_observer = 40.0;
const Vector3<double> towards_hole = {-1.0, 0.0, 0.0};

class ObjectPasses : public test::ObjectScenes {
 protected:
  static Vector3<double> in_view(const EyeCamera& eye, const Vector3<double>& n) {
    const auto part = [&](int i) {
      return eye.frame_from_view[0][i] * n.x + eye.frame_from_view[1][i] * n.y + eye.frame_from_view[2][i] * n.z;
    };
    return {part(0), part(1), part(2)};
  }
};

Projection fisheye(LensLaw law, double field_of_view_deg, double tilt_deg) {
  DomeView dome;
  dome.law = law;
  dome.field_of_view = one_degree * field_of_view_deg;
  dome.tilt = one_degree * tilt_deg;
  return make_dome_projection(512, dome);
}

TEST_F(ObjectPasses, EveryProjectionHasASphereWhereItHasItsDirection) {
  // The sphere is next to the observer. Its second image, whose light goes around the hole, appears
  // near the hole and is too small to move the center of the light.
  const Vector3<double> position{36.0, 3.0, 4.0};
  const EyeCamera eye = eye_looking(pass_r_observer, {-0.6, 0.0, 0.8});
  const Vector3<double> expected = in_view(eye, closed_form_direction(pass_r_observer, position, 1));
  DomeView polynomial;
  polynomial.law = LensLaw::polynomial;
  polynomial.field_of_view = 200.0 * one_degree;
  polynomial.coefficient[0] = 0.6;
  polynomial.coefficient[1] = -0.01;
  polynomial.viewer = {0.1, 0.05, -0.1};
  const std::vector<std::pair<const char*, Projection>> projections = {
      {"pinhole", make_pinhole_projection(512, 256, 120.0 * one_degree)},
      {"frustum", make_frustum_projection(512, 256, {-1.0, 2.0, 1.0, -0.5})},
      {"dome", fisheye(LensLaw::equidistant, 180.0, 0.0)},
      {"tilted dome", fisheye(LensLaw::equidistant, 220.0, 30.0)},
      {"equisolid", fisheye(LensLaw::equisolid, 180.0, 20.0)},
      {"stereographic", fisheye(LensLaw::stereographic, 180.0, 20.0)},
      {"orthographic", fisheye(LensLaw::orthographic, 180.0, 60.0)},
      {"polynomial, off the middle", make_dome_projection(512, polynomial)},
      {"equirectangular", make_equirectangular_projection(512, 256)},
      {"half a sphere", make_equirectangular_projection(512, 512, pi)},
      {"cube", make_cube_projection(128, CubeLayout::cross)},
      {"cylinder", make_cylinder_projection(512, 256, 200.0 * one_degree, -1.0, 1.0)},
      {"from outside", seen_from_outside(fisheye(LensLaw::equidistant, 180.0, 10.0))}};
  for (const auto& [name, projection] : projections) {
    SCOPED_TRACE(name);
    double x = 0.0;
    double y = 0.0;
    ASSERT_TRUE(pixel_from_direction(projection, expected, x, y));
    ASSERT_GT(image_coverage(projection, x, y), 0.9);
    const auto drawn = draw(show_of({small_sphere(position, 0.15)}), eye, projection);
    double x_drawn = 0.0;
    double y_drawn = 0.0;
    drawn.middle(x_drawn, y_drawn);
    EXPECT_GT(drawn.light(), 5.0);
    EXPECT_NEAR(x_drawn, x, 0.2);
    EXPECT_NEAR(y_drawn, y, 0.2);
  }
}

TEST_F(ObjectPasses, WhatCrossesTheSeamOfAPanoramaIsOnBothSides) {
  const Vector3<double> position{44.0, 0.0, 0.3};
  const Projection projection = make_equirectangular_projection(512, 256);
  const auto whole =
      draw(show_of({small_sphere(position, 0.8)}), eye_looking(pass_r_observer, {1.0, 0.0, 0.0}), projection);
  const auto split =
      draw(show_of({small_sphere(position, 0.8)}), eye_looking(pass_r_observer, towards_hole), projection);
  EXPECT_NEAR(split.light(), whole.light(), 0.02 * whole.light());
  double left = 0.0;
  double middle = 0.0;
  split.each([&](double x, double y, double value) {
    left += x < 64.0 ? value : 0.0;
    // The second image is around the hole.
    middle += x > 64.0 && x < 448.0 && std::abs(y - 128.0) > 20.0 ? value : 0.0;
  });
  EXPECT_NEAR(left, 0.5 * split.light(), 0.1 * split.light());
  EXPECT_EQ(middle, 0.0);
}

TEST_F(ObjectPasses, NothingIsDrawnAcrossADomeByWhatIsBehindIt) {
  // Positions opposite to the zenith, and behind the rim of the dome.
  const EyeCamera eye = eye_looking(pass_r_observer, towards_hole);
  for (const Vector3<double>& position : {Vector3<double>{40.0, 0.2, -5.0}, {40.0, 0.0, -5.0}, {44.0, 0.0, 0.0}}) {
    ObjectSettings sphere = small_sphere(position, 1.0);
    sphere.tessellation.maximum = 1.0;
    const auto drawn = draw(show_of({sphere}), eye, fisheye(LensLaw::equidistant, 180.0, 0.0));
    drawn.each([&](double x, double y, double value) {
      const double from_middle = std::hypot(x - 256.0, y - 256.0) / 256.0;
      // The second image is at the front, in a ring of about 8° around the hole, where light is
      // expected.
      const bool about_hole = y > 400.0 && std::abs(x - 256.0) < 60.0;
      if (value > 0.0 && !about_hole) {
        ASSERT_GT(from_middle, 0.75) << position.x << " " << position.z;
      }
    });
  }
}

TEST_F(ObjectPasses, WhatIsNearerByLightTravelTimeHidesTheOther) {
  const Projection projection = make_pinhole_projection(128, 128, 6.0 * one_degree);
  ObjectSettings near = small_sphere({20.0, 0.0, 0.0}, 0.5);
  near.color = {1.0, 0.0, 0.0};
  ObjectSettings far = small_sphere({10.0, 0.0, 0.0}, 1.4);
  far.color = {0.0, 1.0, 0.0};
  for (const auto& objects : {std::vector{near, far}, std::vector{far, near}}) {
    const auto drawn = draw(show_of(objects), eye_looking(pass_r_observer, towards_hole), projection);
    EXPECT_EQ(drawn.at(64, 64, 0), 1.0F);
    EXPECT_EQ(drawn.at(64, 64, 1), 0.0F);
    EXPECT_EQ(drawn.at(64, 25, 0), 0.0F);
    EXPECT_EQ(drawn.at(64, 25, 1), 1.0F);
  }
}

TEST_F(ObjectPasses, EdgesAreMixedWithWhatIsBehind) {
  const Show show = show_of({small_sphere({20.0, 0.0, 0.0}, 0.5)});
  ObjectPass pass(show);
  std::vector<float> rgba(4UL * 64 * 64, 0.25F);
  pass.draw(eye_looking(pass_r_observer, towards_hole), make_pinhole_projection(64, 64, 6.0 * one_degree), 0.0,
            rgba.data());
  int mixed = 0;
  for (std::size_t i = 0; i < rgba.size(); i += 4) {
    EXPECT_GE(rgba[i], 0.25F);
    EXPECT_LE(rgba[i], 1.0F);
    EXPECT_EQ(rgba[i + 3], 0.25F);
    mixed += rgba[i] > 0.3F && rgba[i] < 0.95F ? 1 : 0;
  }
  EXPECT_GT(mixed, 40);
}

TEST_F(ObjectPasses, LitSurfacesShineAsTheIlluminationOfBothWaysRoundTheHoleSays) {
  ObjectSettings sphere = small_sphere({10.0, 3.0, 0.0}, 0.5);
  sphere.sphere = {256, 128};
  sphere.lit = true;
  Show show = show_of({sphere});
  show.light = PointLight{{30.0, 12.0, 9.0}, 900.0};
  const Vector3<double> facing = {30.0 - 10.0, 12.0 - 3.0, 9.0};
  const Vector3<double> normal = (1.0 / std::sqrt(dot(facing, facing))) * facing;
  const Vector3<double> point = sphere.position + 0.5 * normal;
  const double expected = illuminance(show.light->position, point, normal, 1, 900.0) +
                          illuminance(show.light->position, point, normal, 2, 900.0);
  const auto drawn = draw(show, eye_looking(pass_r_observer, closed_form_direction(pass_r_observer, point, 1)),
                          make_pinhole_projection(65, 65, 0.4 * one_degree));
  EXPECT_GT(expected, 0.5);
  EXPECT_NEAR(drawn.at(32, 32), expected, 0.01 * expected);
}

TEST_F(ObjectPasses, ACheckerboardDarkensEveryOtherField) {
  ObjectSettings triangle;
  triangle.form = ObjectForm::triangle;
  triangle.triangle.corners = {{{0.0, -2.0, -2.0}, {0.0, 6.0, -2.0}, {0.0, -2.0, 6.0}}};
  triangle.position = {20.0, 0.0, 0.0};
  triangle.checker = CheckerSettings{4, 4, 0.25};
  const auto drawn = draw(show_of({triangle}), eye_looking(pass_r_observer, towards_hole),
                          make_pinhole_projection(64, 64, 8.0 * one_degree));
  double light = 0.0;
  double dark = 0.0;
  drawn.each([&](double /*x*/, double /*y*/, double value) {
    light += value > 0.99 ? 1.0 : 0.0;
    dark += value > 0.24 && value < 0.26 ? 1.0 : 0.0;
  });
  EXPECT_GT(light, 1000.0);
  EXPECT_GT(dark, 1000.0);
}

TEST_F(ObjectPasses, MoreTessellationMovesTheMiddleOfAnEdgeToWhereItIsSeen) {
  ObjectSettings triangle;
  triangle.form = ObjectForm::triangle;
  triangle.triangle.corners = {{{0.0, -3.0, 0.0}, {0.0, 3.0, 0.0}, {0.0, 0.0, 3.0}}};
  triangle.position = {-5.0, 0.0, 1.5};
  const EyeCamera eye = eye_looking(pass_r_observer, towards_hole);
  const Projection projection = make_pinhole_projection(256, 256, 25.0 * one_degree);
  const Vector3<double> inside = closed_form_direction(pass_r_observer, {-5.0, 0.0, 1.6}, 1);
  double x = 0.0;
  double y = 0.0;
  ASSERT_TRUE(pixel_from_direction(projection, in_view(eye, inside), x, y));
  double areas[3] = {};
  const double levels[3] = {1.0, 4.0, 64.0};
  for (int i = 0; i < 3; ++i) {
    triangle.tessellation.maximum = levels[i];
    areas[i] = draw(show_of({triangle}), eye, projection).light();
  }
  // The edge of the triangle is curved outwards, away from the shadow. The coarser its tessellation
  // is, the more its chords cut off.
  EXPECT_GT(std::abs(areas[0] - areas[2]), 4.0 * std::abs(areas[1] - areas[2]));
  triangle.tessellation.maximum = 64.0;
  const auto drawn = draw(show_of({triangle}), eye, projection);
  EXPECT_EQ(drawn.at(static_cast<int>(x), static_cast<int>(y)), 1.0F);
}

TEST_F(ObjectPasses, RefuseObjectsInTheHoleAndEyesInsideThePhotonSphere) {
  const Projection projection = make_pinhole_projection(16, 16, one_degree);
  const auto drawn_from = [&](double r, const ObjectSettings& object) {
    return test::error_of([&] { draw(show_of({object}), eye_looking(r, towards_hole), projection); });
  };
  EXPECT_THAT(
      drawn_from(40.0, small_sphere({3.0, 0.0, 0.0}, 1.0)),
      testing::AllOf(testing::HasSubstr("scene.toml: objects[0]: extends from r = 2"), testing::HasSubstr("2.1 M")));
  EXPECT_THAT(drawn_from(40.0, small_sphere({9e4, 0.0, 0.0}, 2e4)), testing::HasSubstr("extends from r = "));
  EXPECT_THAT(drawn_from(2.9, small_sphere({9.0, 0.0, 0.0}, 1.0)), testing::HasSubstr("photon sphere"));
  EXPECT_EQ(drawn_from(3.1, small_sphere({9.0, 0.0, 0.0}, 1.0)), "");
  // A sphere and a disk that enclose the hole are outside the hole, although their centers are not.
  EXPECT_EQ(drawn_from(40.0, small_sphere({0.0, 0.0, 0.0}, 5.0)), "");
  ObjectSettings disk;
  disk.form = ObjectForm::disk;
  // The tessellation is coarse, because it only matters whether the disk is drawn.
  disk.tessellation.maximum = 1.0;
  EXPECT_EQ(drawn_from(40.0, disk), "");
  disk.disk.inner = 1.9;
  EXPECT_THAT(drawn_from(40.0, disk), testing::HasSubstr("extends from r = "));
}

using MeshesInShows = test::FolderTest;

TEST_F(MeshesInShows, AMissingOrEmptyMeshIsAnErrorThatNamesItsFile) {
  Show show;
  show.folder = folder_.string();
  show.objects.emplace_back();
  show.objects.front().form = ObjectForm::mesh;
  show.objects.front().mesh = "none.obj";
  EXPECT_THAT(test::error_of([&] { ObjectPass::mesh_bytes(show); }), testing::HasSubstr("none.obj"));
  std::ofstream(folder_ / "none.obj") << "v 0 0 0\n";
  EXPECT_THAT(test::error_of([&] { ObjectPass::mesh_bytes(show); }), testing::HasSubstr("none.obj"));
  std::ofstream(folder_ / "none.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  show.objects.push_back(show.objects.front());
  EXPECT_EQ(ObjectPass::mesh_bytes(show), 3 * 44 + 3 * 4);
}

}  // namespace
}  // namespace ergodome
