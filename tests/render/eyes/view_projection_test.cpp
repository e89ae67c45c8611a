#include "render/eyes/view_projection.h"

#include <gtest/gtest.h>

#include "kernels/core/angles.h"
#include "kernels/projection/make_projection.h"
#include "kernels/projection/pixel_measure.h"
#include "render/picture/cube_pictures.h"

namespace ergodome {
namespace {

TEST(ViewProjection, OfACubeHasTheWidthThatWasAskedFor) {
  ViewSettings view;
  view.projection = ViewProjection::cube;
  const Projection cross = make_projection(view, 400, 0.0);
  EXPECT_EQ(cross.width_px, 400);
  EXPECT_EQ(cross.height_px, 300);
  view.cube_files = CubeFiles::strip;
  const Projection strip = make_projection(view, 600, 0.0);
  EXPECT_EQ(strip.width_px, 600);
  EXPECT_EQ(strip.height_px, 100);
  view.cube_files = CubeFiles::faces;
  EXPECT_EQ(make_projection(view, 100, 0.0).width_px, 600);
}

TEST(ViewProjection, OfACylinderHasSquarePixelsOnTheHorizon) {
  ViewSettings view;
  view.projection = ViewProjection::cylinder;
  view.field_of_view_deg = 360.0;
  view.height_deg = 90.0;
  const Projection p = make_projection(view, 1024, 0.0);
  EXPECT_EQ(p.height_px, 326);
  const PixelSteps<double> steps = pixel_steps(p, 512.0, 163.0);
  EXPECT_NEAR(std::sqrt(dot(steps.down, steps.down) / dot(steps.across, steps.across)), 1.0, 2e-3);
}

TEST(ViewProjection, OfAPartOfASphereHasSquarePixelsOnTheHorizon) {
  ViewSettings view;
  view.projection = ViewProjection::equirect;
  view.field_of_view_deg = 180.0;
  EXPECT_EQ(make_projection(view, 512, 0.0).height_px, 512);
  view.field_of_view_deg = 120.0;
  EXPECT_EQ(make_projection(view, 512, 90.0).height_px, 768) << "the zoom of a player does not change a panorama";
  view.field_of_view_deg = 360.0;
  const Projection whole = make_projection(view, 512, 0.0);
  EXPECT_EQ(whole.height_px, 256);
  EXPECT_TRUE(wraps_around(whole));
}

TEST(ViewProjection, OfASliverIsNoHigherThanPicturesMayBe) {
  ViewSettings view;
  view.projection = ViewProjection::cylinder;
  view.field_of_view_deg = 1e-6;
  EXPECT_EQ(make_projection(view, 16384, 0.0).height_px, 16384);
}

TEST(ViewProjection, OfAFrustumHasSquarePixels) {
  ViewSettings view;
  view.projection = ViewProjection::pinhole;
  view.frustum = FrustumAngles{-45.0, 45.0, 0.0, -45.0};
  const Projection p = make_projection(view, 200, 0.0);
  EXPECT_EQ(p.height_px, 100);
  EXPECT_NEAR(direction_from_pixel(p, 100.0, 0.0).y, 0.0, 1e-12);
}

TEST(ViewProjection, StopsAtWhatALensCanSee) {
  ViewSettings view;
  view.lens = LensLaw::orthographic;
  const Projection p = make_projection(view, 100, 300.0);
  EXPECT_NEAR(p.dome.lens.half_angle, pi / 2, 1e-12);
}

TEST(ViewProjection, FromOutsideIsMirrored) {
  ViewSettings view;
  view.from_outside = true;
  EXPECT_LT(direction_from_pixel(make_projection(view, 100, 0.0), 90.0, 50.0).x, 0.0);
}

//! Returns a picture of a strip in which every pixel has a different value.
Picture numbered(int width, int height) {
  Picture picture;
  picture.width = width;
  picture.height = height;
  for (int i = 0; i < 4 * width * height; ++i) {
    picture.rgba.push_back(static_cast<float>(i));
  }
  return picture;
}

TEST(CubePictures, AreCutOutOfTheirStrip) {
  const Projection p = make_cube_projection(2, CubeLayout::strip);
  const auto faces = cube_face_pictures(numbered(12, 2), p);
  EXPECT_EQ(faces[3].width, 2);
  EXPECT_EQ(faces[3].height, 2);
  EXPECT_EQ(faces[3].rgba[0], 24.0F);
  EXPECT_EQ(faces[3].rgba[8], 4.0F * 12 + 24.0F);
}

TEST(CubePictures, OfBothEyesStaySideBySide) {
  const Projection p = make_cube_projection(2, CubeLayout::strip);
  const auto faces = cube_face_pictures(numbered(24, 2), p);
  EXPECT_EQ(faces[1].width, 4);
  EXPECT_EQ(faces[1].rgba[0], 8.0F);
  EXPECT_EQ(faces[1].rgba[8], 4.0F * 12 + 8.0F);
}

TEST(CubePictures, OfAMirroredStripKeepTheirNames) {
  const Projection p = seen_from_outside(make_cube_projection(2, CubeLayout::strip));
  const auto faces = cube_face_pictures(numbered(12, 2), p);
  EXPECT_EQ(faces[0].rgba[0], 40.0F);
}

}  // namespace
}  // namespace ergodome
