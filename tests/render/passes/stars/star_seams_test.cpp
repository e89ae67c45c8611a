#include <gtest/gtest.h>

#include <random>

#include "kernels/projection/cube_cells.h"
#include "kernels/projection/pixel_measure.h"
#include "render/passes/effects/diffraction.h"
#include "render/passes/stars/drawing/star_splat.h"
#include "tests/render/passes/stars/star_cameras.h"
#include "tests/support/projections.h"

// Tests of stars at the seams of pictures.
namespace ergodome {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): the cameras and stars of these tests

//! Returns an eye for which the axes of the view are those of the observer's frame.
EyeCamera seam_eye() {
  EyeCamera eye{};
  for (int i = 0; i < 3; ++i) {
    eye.frame_from_view[i][i] = 1.0;
  }
  return eye;
}

StarImage image_at(const Vector3<double>& way) {
  const Vector3<double> n = unit_of(way);
  return {
      0, {static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)}, 1.0F, 1.0F, {1.0F, 1.0F, 1.0F}};
}

std::vector<float> drawn(const std::vector<StarPoint>& points, const Projection& projection,
                         const SplatSettings& settings) {
  std::vector<float> rgba(4 * static_cast<std::size_t>(projection.width_px) *
                          static_cast<std::size_t>(projection.height_px));
  splat_points(points, projection, settings, 0, projection.height_px, rgba.data());
  return rgba;
}

std::vector<float> drawn(const std::vector<StarImage>& images, const Projection& projection, double sigma_px) {
  const SplatSettings settings{sigma_px, 1.0F};
  return drawn(star_points(images, seam_eye(), projection, settings), projection, settings);
}

//! Returns the sum of the green channel in a rectangle of a picture.
double light_in(const std::vector<float>& rgba, const Projection& projection, const PixelCell& cell) {
  double sum = 0.0;
  for (int y = cell.top_px; y < cell.top_px + cell.height_px; ++y) {
    for (int x = cell.left_px; x < cell.left_px + cell.width_px; ++x) {
      sum += static_cast<double>(rgba[4 * static_cast<std::size_t>(y * projection.width_px + x) + 1]);
    }
  }
  return sum;
}

double light_on(const std::vector<float>& rgba, const Projection& projection, CubeFace face) {
  return light_in(rgba, projection, cube_face_cell(projection, face));
}

class LightOfStars : public testing::TestWithParam<NamedProjection> {};

TEST_P(LightOfStars, IsTheSameInEveryProjection) {
  const Projection& projection = GetParam().projection;
  std::mt19937 random(5);
  std::normal_distribution<double> axis;
  std::vector<StarImage> images;
  for (int i = 0; i < 6000; ++i) {
    const StarImage image = image_at({axis(random), axis(random), axis(random)});
    double x = 0.0;
    double y = 0.0;
    if (!pixel_from_direction(projection, widened(image.direction), x, y)) {
      continue;
    }
    // Keeps only stars that are away from the edges of the image, which cut off their spots, and
    // from the poles of a panorama, where a spot would have to extend around the pole.
    const bool cube = projection.kind == ProjectionKind::cube && projection.cube.layout != CubeLayout::face;
    const bool inside = cube || (y > 12.0 && y < projection.height_px - 12.0 &&
                                 (wraps_around(projection) || (x > 12.0 && x < projection.width_px - 12.0)));
    const bool lit = cube || (image_coverage(projection, x - 10.0, y - 10.0) >= 1.0 &&
                              image_coverage(projection, x + 10.0, y - 10.0) >= 1.0 &&
                              image_coverage(projection, x - 10.0, y + 10.0) >= 1.0 &&
                              image_coverage(projection, x + 10.0, y + 10.0) >= 1.0);
    const bool even = pixel_solid_angle(projection, x, y) > 0.1 * pixel_angle(projection) * pixel_angle(projection);
    if (inside && lit && even) {
      images.push_back(image);
    }
  }
  ASSERT_GT(images.size(), 100U);
  for (const double sigma_px : {0.0, 0.7, 2.0}) {
    const double light = light_of(drawn(images, projection, sigma_px), projection);
    EXPECT_NEAR(light / static_cast<double>(images.size()), 1.0, 0.01) << sigma_px;
  }
}

INSTANTIATE_TEST_SUITE_P(Each, LightOfStars, testing::ValuesIn(every_projection()),
                         [](const auto& each) { return each.param.name; });

TEST(StarsAtSeams, OnTheEdgeOfACubeShineOnBothFaces) {
  for (const CubeLayout layout : {CubeLayout::cross, CubeLayout::strip}) {
    const Projection projection = make_cube_projection(64, layout);
    const auto rgba = drawn({image_at({1.0, 1.0, 0.1})}, projection, 1.0);
    const double right = light_on(rgba, projection, CubeFace::right);
    const double top = light_on(rgba, projection, CubeFace::top);
    EXPECT_GT(right, 0.0);
    EXPECT_NEAR(top / right, 1.0, 0.1);
  }
}

TEST(StarsAtSeams, InACornerOfACubeShineOnThreeFacesAndNoOther) {
  const Projection projection = make_cube_projection(64, CubeLayout::cross);
  const auto rgba = drawn({image_at({-1.0, -1.0, -1.0})}, projection, 1.0);
  const double left = light_on(rgba, projection, CubeFace::left);
  EXPECT_NEAR(light_on(rgba, projection, CubeFace::bottom) / left, 1.0, 0.1);
  EXPECT_NEAR(light_on(rgba, projection, CubeFace::front) / left, 1.0, 0.1);
  EXPECT_EQ(light_on(rgba, projection, CubeFace::right), 0.0);
  EXPECT_EQ(light_on(rgba, projection, CubeFace::top), 0.0);
  EXPECT_EQ(light_on(rgba, projection, CubeFace::back), 0.0);
}

TEST(StarsAtSeams, LeaveTheEmptyCellsOfACrossBlack) {
  const Projection projection = make_cube_projection(64, CubeLayout::cross);
  const auto rgba = drawn({image_at({1.0, 1.0, -1.0}), image_at({1.0, 1.0, 0.0})}, projection, 2.0);
  EXPECT_EQ(light_in(rgba, projection, {128, 0, 128, 64}), 0.0);
}

TEST(StarsAtSeams, BehindTheViewerShineOnBothSidesOfAWholeCylinder) {
  const Projection projection = make_cylinder_projection(512, 160, 2.0 * pi, -1.0, 1.0);
  const auto rgba = drawn({image_at({0.0, 0.2, 1.0})}, projection, 1.0);
  const double left = light_in(rgba, projection, {0, 0, 8, 160});
  EXPECT_GT(left, 0.0);
  EXPECT_NEAR(light_in(rgba, projection, {504, 0, 8, 160}) / left, 1.0, 0.1);
}

TEST(StarsAtSeams, BehindTheViewerEndWithAPartOfACylinder) {
  const Projection projection = make_cylinder_projection(512, 160, 6.0, -1.0, 1.0);
  const auto rgba = drawn({image_at({0.0, 0.2, 1.0})}, projection, 1.0);
  EXPECT_EQ(light_in(rgba, projection, {0, 0, 512, 160}), 0.0);
}

TEST(StarsAtSeams, KeepTheLightOfTrailsAcrossTheEdgesOfACube) {
  StarTrails trails;
  trails.positions = 21;
  for (int i = -10; i <= 10; ++i) {
    // The trail goes from the right face across a corner of the top face to the back face.
    trails.directions.push_back(image_at({1.0 - 0.02 * i, 1.0 - 0.005 * i, 1.0 + 0.03 * i}).direction);
  }
  trails.ways = {{0, 20, {1.0F, 1.0F, 1.0F}}};
  const Shutter shutter{std::vector<StarEye>(21, seam_eye())};
  for (const CubeLayout layout : {CubeLayout::cross, CubeLayout::strip}) {
    const Projection projection = make_cube_projection(256, layout);
    const SplatSettings settings{0.7, 1.0F};
    const auto points = trail_points(trails, shutter, projection, settings);
    EXPECT_NEAR(light_of(drawn(points, projection, settings), projection), 1.0, 0.01);
    EXPECT_LT(points.size(), 1000U);
  }
}

TEST(StarsAtSeams, MirroredPicturesAreTheMirrorImage) {
  const Projection inside = make_dome_projection(128, pi, 0.0);
  const std::vector<StarImage> images = {image_at({0.5, 0.8, -0.4}), image_at({-0.1, 0.9, 0.6})};
  const auto seen = drawn(images, inside, 0.0);
  const auto mirrored = drawn(images, seen_from_outside(inside), 0.0);
  for (std::size_t y = 0; y < 128; ++y) {
    for (std::size_t x = 0; x < 128; ++x) {
      ASSERT_NEAR(seen[4 * (128 * y + x)], mirrored[4 * (128 * y + 127 - x)], 1e-3F * seen[4 * (128 * y + x)]);
    }
  }
}

TEST(StarsAtSeams, SpikesStayWithinTheColumnsOfTheirFace) {
  const DiffractionPattern pattern = {3, std::vector<float>(27, 1.0F / 9.0F)};
  std::vector<float> rgba(4 * 10 * 4);
  add_diffraction(pattern, 4.0, 2.0, {1.0F, 1.0F, 1.0F}, PixelBlock{10, 4, 4, 8, rgba.data()});
  for (std::size_t y = 0; y < 4; ++y) {
    for (std::size_t x = 0; x < 10; ++x) {
      EXPECT_EQ(rgba[4 * (10 * y + x)] > 0.0F, x == 4 || x == 5) << x << " " << y;
    }
  }
}

}  // namespace
}  // namespace ergodome
