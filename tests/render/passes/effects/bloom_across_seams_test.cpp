#include "render/passes/effects/bloom_across_seams.h"

#include <gtest/gtest.h>

#include "kernels/core/angles.h"
#include "kernels/projection/cube_cells.h"

namespace ergodome {
namespace {

//! Returns a picture with uniform light in all pixels of the projection's image.
Picture uniform_picture(const Projection& projection, float value) {
  Picture picture;
  picture.width = projection.width_px;
  picture.height = projection.height_px;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const bool lit = image_coverage(projection, x + 0.5, y + 0.5) > 0.0;
      picture.rgba.insert(picture.rgba.end(), 4, lit ? value : 0.0F);
    }
  }
  return picture;
}

float& green(Picture& picture, int x, int y) {
  return picture.rgba[4 * static_cast<std::size_t>(y * picture.width + x) + 1];
}

double light_in(Picture& picture, const PixelCell& cell) {
  double sum = 0.0;
  for (int y = cell.top_px; y < cell.top_px + cell.height_px; ++y) {
    for (int x = cell.left_px; x < cell.left_px + cell.width_px; ++x) {
      sum += static_cast<double>(green(picture, x, y));
    }
  }
  return sum;
}

TEST(BloomAcrossSeams, GoesRoundPicturesOfTheWholeTurn) {
  for (const Projection& projection :
       {make_equirectangular_projection(256, 128), make_cylinder_projection(256, 128, 2.0 * pi, -1.0, 1.0)}) {
    Picture picture = uniform_picture(projection, 0.0F);
    green(picture, 0, 64) = 1000.0F;
    add_bloom(picture, projection, {1.0, 6.0});
    EXPECT_NEAR(light_in(picture, {0, 0, 256, 128}), 1000.0, 10.0);
    EXPECT_NEAR(light_in(picture, {128, 0, 128, 128}), 500.0, 100.0);
  }
}

TEST(BloomAcrossSeams, StaysOnOneSideOfAPartOfACylinder) {
  const Projection projection = make_cylinder_projection(256, 128, 3.0, -1.0, 1.0);
  Picture picture = uniform_picture(projection, 0.0F);
  green(picture, 0, 64) = 1000.0F;
  add_bloom(picture, projection, {1.0, 6.0});
  EXPECT_NEAR(light_in(picture, {128, 0, 128, 128}), 0.0, 1.0);
}

TEST(BloomAcrossSeams, GoesOverTheEdgesOfACube) {
  const Projection projection = make_cube_projection(64, CubeLayout::cross);
  Picture picture = uniform_picture(projection, 0.0F);
  const PixelCell right = cube_face_cell(projection, CubeFace::right);
  const PixelCell top = cube_face_cell(projection, CubeFace::top);
  green(picture, right.left_px + 30, right.top_px) = 1000.0F;
  add_bloom(picture, projection, {1.0, 4.0});
  const double on_right = light_in(picture, right);
  const double on_top = light_in(picture, top);
  EXPECT_NEAR(on_right + on_top, 1000.0, 100.0);
  EXPECT_NEAR(on_top / on_right, 1.0, 0.4);
}

TEST(BloomAcrossSeams, LeavesAUniformCubeAsItIs) {
  for (const CubeLayout layout : {CubeLayout::cross, CubeLayout::strip}) {
    const Projection projection = make_cube_projection(33, layout);
    Picture picture = uniform_picture(projection, 0.5F);
    add_bloom(picture, projection, {0.7, 10.0});
    for (int face = 0; face < cube_faces; ++face) {
      const PixelCell cell = cube_face_cell(projection, static_cast<CubeFace>(face));
      EXPECT_NEAR(light_in(picture, cell), 0.5 * 33 * 33, 1e-3) << face;
    }
  }
}

}  // namespace
}  // namespace ergodome
