#include "kernels/projection/cube_faces.h"

#include <gtest/gtest.h>

#include "kernels/projection/make_projection.h"

namespace ergodome {
namespace {

//! A face of a cube map in OpenGL (4.6 core, table 8.19): its axis (X, Y or Z), and the axes along
//! which its coordinates s (to the right) and t (downwards) increase.
struct FaceOfOpenGl {
  CubeFace face;
  int ahead[3];
  int s[3];
  int t[3];
};

constexpr FaceOfOpenGl faces_of_opengl[] = {
    {CubeFace::right, {1, 0, 0}, {0, 0, -1}, {0, -1, 0}}, {CubeFace::left, {-1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
    {CubeFace::top, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}},     {CubeFace::bottom, {0, -1, 0}, {1, 0, 0}, {0, 0, -1}},
    {CubeFace::front, {0, 0, 1}, {1, 0, 0}, {0, -1, 0}},  {CubeFace::back, {0, 0, -1}, {-1, 0, 0}, {0, -1, 0}}};

TEST(CubeFaces, AreThoseOfOpenGlWithZForward) {
  for (const FaceOfOpenGl& expected : faces_of_opengl) {
    const Projection p = make_cube_face_projection(100, expected.face);
    const Vector3<double> v = direction_from_pixel(p, 80.0, 30.0);
    const double sc = 0.6;
    const double tc = -0.4;
    const auto axis = [&](int i) { return expected.ahead[i] + sc * expected.s[i] + tc * expected.t[i]; };
    const double length = std::sqrt(1.0 + sc * sc + tc * tc);
    EXPECT_NEAR(v.x, axis(0) / length, 1e-12) << static_cast<int>(expected.face);
    EXPECT_NEAR(v.y, axis(1) / length, 1e-12) << static_cast<int>(expected.face);
    EXPECT_NEAR(-v.z, axis(2) / length, 1e-12) << static_cast<int>(expected.face);
  }
}

TEST(CubeFaces, OfTheStripStandInOpenGlsOrder) {
  const Projection strip = make_cube_projection(100, CubeLayout::strip);
  ASSERT_EQ(strip.width_px, 600);
  ASSERT_EQ(strip.height_px, 100);
  for (int face = 0; face < cube_faces; ++face) {
    const Projection alone = make_cube_face_projection(100, static_cast<CubeFace>(face));
    const Vector3<double> there = direction_from_pixel(strip, 100.0 * face + 20.0, 70.0);
    const Vector3<double> here = direction_from_pixel(alone, 20.0, 70.0);
    EXPECT_NEAR(dot(here, there), 1.0, 1e-12);
  }
}

TEST(CubeFaces, OfTheCrossStandAboutTheFront) {
  const Projection cross = make_cube_projection(100, CubeLayout::cross);
  ASSERT_EQ(cross.width_px, 400);
  ASSERT_EQ(cross.height_px, 300);
  EXPECT_NEAR(direction_from_pixel(cross, 150.0, 150.0).z, -1.0, 1e-12);
  EXPECT_NEAR(direction_from_pixel(cross, 50.0, 150.0).x, -1.0, 1e-12);
  EXPECT_NEAR(direction_from_pixel(cross, 250.0, 150.0).x, 1.0, 1e-12);
  EXPECT_NEAR(direction_from_pixel(cross, 350.0, 150.0).z, 1.0, 1e-12);
  EXPECT_NEAR(direction_from_pixel(cross, 150.0, 50.0).y, 1.0, 1e-12);
  EXPECT_NEAR(direction_from_pixel(cross, 150.0, 250.0).y, -1.0, 1e-12);
}

TEST(CubeFaces, MeetAlongTheSidesThatTheCrossJoins) {
  const Projection cross = make_cube_projection(100, CubeLayout::cross);
  const auto expect_meeting = [&](double x, double y, double dx, double dy) {
    const Vector3<double> before = direction_from_pixel(cross, x - dx, y - dy);
    const Vector3<double> after = direction_from_pixel(cross, x + dx, y + dy);
    EXPECT_NEAR(dot(before, after), 1.0, 1e-9) << x << " " << y;
  };
  for (const double along : {3.0, 40.0, 97.0}) {
    expect_meeting(100.0, 100.0 + along, 1e-5, 0.0);
    expect_meeting(200.0, 100.0 + along, 1e-5, 0.0);
    expect_meeting(300.0, 100.0 + along, 1e-5, 0.0);
    expect_meeting(100.0 + along, 100.0, 0.0, 1e-5);
    expect_meeting(100.0 + along, 200.0, 0.0, 1e-5);
  }
}

TEST(CubeFaces, LeaveTheRestOfTheCrossBlack) {
  const Projection cross = make_cube_projection(2, CubeLayout::cross);
  const char* const picture[] = {"..##....", "..##....", "########", "########", "..##....", "..##...."};
  for (int y = 0; y < 6; ++y) {
    for (int x = 0; x < 8; ++x) {
      EXPECT_EQ(image_coverage(cross, x + 0.5, y + 0.5), picture[y][x] == '#' ? 1.0 : 0.0) << x << " " << y;
    }
  }
}

TEST(CubeFaces, OfAMirroredCrossLeaveTheMirroredRestBlack) {
  const Projection cross = seen_from_outside(make_cube_projection(2, CubeLayout::cross));
  EXPECT_EQ(image_coverage(cross, 4.5, 0.5), 1.0);
  EXPECT_EQ(image_coverage(cross, 2.5, 0.5), 0.0);
}

TEST(CubeFaces, AloneHaveNoPlaceForWhatIsBehindThem) {
  double x = 0.0;
  double y = 0.0;
  EXPECT_FALSE(pixel_from_direction(make_cube_face_projection(10, CubeFace::top), {0.0, -1.0, 0.0}, x, y));
}

TEST(CubeFaces, EdgesAndCornersHaveAPlaceInThePicture) {
  for (const CubeLayout layout : {CubeLayout::cross, CubeLayout::strip}) {
    const Projection p = make_cube_projection(100, layout);
    for (int i = 0; i < 27; ++i) {
      const int up = i / 3 % 3;
      const int back = i / 9;
      const Vector3<double> way = {i % 3 - 1.0, up - 1.0, back - 1.0};
      if (dot(way, way) > 0.0) {
        const Vector3<double> view = (1.0 / std::sqrt(dot(way, way))) * way;
        double x = 0.0;
        double y = 0.0;
        ASSERT_TRUE(pixel_from_direction(p, view, x, y));
        EXPECT_NEAR(dot(direction_from_pixel(p, x, y), view), 1.0, 1e-12) << i;
      }
    }
  }
}

}  // namespace
}  // namespace ergodome
