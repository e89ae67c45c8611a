#include "calibration/warps/warp_conversion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "calibration/formats/warps/bourke_mesh.h"
#include "tests/support/errors.h"

namespace ergodome {
namespace {

using testing::HasSubstr;

constexpr float unknown = std::numeric_limits<float>::quiet_NaN();

//! Returns a mesh over the whole raster with u = 0.1 + 0.8 x, v = 0.9 - 0.5 y + 0.2 x and intensity
//! 1 - x / 2. These are linear, so that every interpolation gives the same values.
WarpMesh linear_mesh(int columns, int rows) {
  WarpMesh mesh{MeshTopology::rectangular, columns, rows, {}};
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const double x = column / (columns - 1.0);
      const double y = row / (rows - 1.0);
      mesh.nodes.push_back({static_cast<float>(x), static_cast<float>(y), static_cast<float>(0.1 + 0.8 * x),
                            static_cast<float>(0.9 - 0.5 * y + 0.2 * x), static_cast<float>(1.0 - 0.5 * x), true});
    }
  }
  return mesh;
}

//! Returns a map in which all samples have different values.
FloatMap sample_map(int width, int height) {
  FloatMap map{width, height, {}};
  for (int i = 0; i < width * height; ++i) {
    map.samples.push_back(0.5F + 0.4F * std::sin(static_cast<float>(i)));
    map.samples.push_back(0.5F + 0.4F * std::cos(1.7F * static_cast<float>(i)));
    map.samples.push_back(0.0F);
  }
  return map;
}

TEST(WarpConversion, SamplesOfAMapStandInTheMiddlesOfTheirParts) {
  const WarpMesh mesh = warp_from_map(sample_map(4, 2), TextureDirection::downwards);
  EXPECT_FLOAT_EQ(mesh.at(0, 0).x, 0.125F);
  EXPECT_FLOAT_EQ(mesh.at(3, 1).x, 0.875F);
  EXPECT_FLOAT_EQ(mesh.at(3, 1).y, 0.75F);
}

TEST(WarpConversion, MapToMeshAndBackIsTheSameMap) {
  for (const TextureDirection direction : {TextureDirection::downwards, TextureDirection::upwards}) {
    const FloatMap map = sample_map(37, 23);
    const FloatMap again = map_from_warp(warp_from_map(map, direction), 37, 23, direction);
    for (std::size_t i = 0; i < map.samples.size(); ++i) {
      EXPECT_NEAR(again.samples[i], map.samples[i], 1e-6) << i;
    }
  }
}

TEST(WarpConversion, UnknownSamplesStayUnknownAndTheirNeighboursKnown) {
  FloatMap map = sample_map(3, 3);
  map.samples[12] = unknown;
  map.samples[0] = std::numeric_limits<float>::infinity();
  const FloatMap again =
      map_from_warp(warp_from_map(map, TextureDirection::downwards), 3, 3, TextureDirection::downwards);
  EXPECT_TRUE(std::isnan(again.samples[12]) && std::isnan(again.samples[13]));
  EXPECT_TRUE(std::isnan(again.samples[0]));
  EXPECT_EQ(again.samples[3], map.samples[3]);
  EXPECT_EQ(again.samples[24], map.samples[24]);
}

TEST(WarpConversion, TextureUpwardsIsTurnedOver) {
  FloatMap map = sample_map(2, 2);
  map.samples[1] = 0.25F;
  EXPECT_FLOAT_EQ(warp_from_map(map, TextureDirection::upwards).nodes[0].v, 0.75F);
}

TEST(WarpConversion, MeshBecomesAMapWithTheValuesBetweenItsNodes) {
  const FloatMap map = map_from_warp(linear_mesh(5, 4), 64, 48, TextureDirection::downwards);
  for (int row = 0; row < 48; ++row) {
    for (int column = 0; column < 64; ++column) {
      const float* sample = &map.samples[3 * (64 * static_cast<std::size_t>(row) + static_cast<std::size_t>(column))];
      const double x = (column + 0.5) / 64.0;
      const double y = (row + 0.5) / 48.0;
      EXPECT_NEAR(sample[0], 0.1 + 0.8 * x, 1e-6);
      EXPECT_NEAR(sample[1], 0.9 - 0.5 * y + 0.2 * x, 1e-6);
    }
  }
}

TEST(WarpConversion, BourkeMeshToMapToBourkeMeshKeepsTheWarp) {
  const WarpMesh mesh = parse_bourke_mesh(to_bourke_mesh(linear_mesh(7, 5), 1.6), "a.data", 1.6);
  const FloatMap map = map_from_warp(mesh, 80, 50, TextureDirection::downwards);
  const WarpMesh grid = warp_from_map(map, TextureDirection::downwards);
  const WarpMesh again = parse_bourke_mesh(to_bourke_mesh(grid, 1.6), "b.data", 1.6);
  ASSERT_EQ(again.columns, 80);
  for (const WarpNode& node : again.nodes) {
    EXPECT_NEAR(node.u, 0.1 + 0.8 * node.x, 1e-6);
    EXPECT_NEAR(node.v, 0.9 - 0.5 * node.y + 0.2 * node.x, 1e-6);
  }
}

TEST(WarpConversion, CellsWithACornerThatIsNotDrawnStayEmpty) {
  WarpMesh mesh = linear_mesh(3, 3);
  mesh.at(0, 0).valid = false;
  const WarpMesh filled = resampled_warp(mesh, 8, 8);
  EXPECT_FALSE(filled.at(0, 0).valid);
  EXPECT_FALSE(filled.at(3, 3).valid);
  EXPECT_TRUE(filled.at(4, 0).valid);
  EXPECT_TRUE(filled.at(0, 4).valid);
}

TEST(WarpConversion, PolarMeshIsClosed) {
  // A polar mesh in the shape of a ring around the middle of the raster. Its last column is next to
  // its first, on both sides of the positive x axis.
  WarpMesh ring{MeshTopology::polar, 12, 2, {}};
  for (const double radius : {0.1, 0.4}) {
    for (int i = 0; i < 12; ++i) {
      const double angle = 2.0 * 3.14159265358979 * (i + 0.5) / 12.0;
      ring.nodes.push_back({static_cast<float>(0.5 + radius * std::cos(angle)),
                            static_cast<float>(0.5 + radius * std::sin(angle)), static_cast<float>(radius), 0.5F, 1.0F,
                            true});
    }
  }
  EXPECT_TRUE(resampled_warp(ring, 41, 41).at(30, 20).valid);
  ring.topology = MeshTopology::rectangular;
  EXPECT_FALSE(resampled_warp(ring, 41, 41).at(30, 20).valid);
}

TEST(WarpConversion, RimIsReachedByGoingStraightOn) {
  const WarpMesh grid = resampled_warp(linear_mesh(3, 3), 2, 2);
  const WarpMesh whole = with_rim(grid);
  ASSERT_EQ(whole.columns, 4);
  ASSERT_EQ(whole.rows, 4);
  for (const WarpNode& node : whole.nodes) {
    EXPECT_NEAR(node.u, 0.1 + 0.8 * node.x, 1e-6);
    EXPECT_NEAR(node.v, 0.9 - 0.5 * node.y + 0.2 * node.x, 1e-6);
  }
  EXPECT_NEAR(whole.at(0, 0).x, 0.0, 1e-7);
  EXPECT_NEAR(whole.at(3, 3).y, 1.0, 1e-7);
}

TEST(WarpConversion, IntensitiesBecomeAMask) {
  const BlendMap mask = mask_from_warp(linear_mesh(3, 3), 10, 4);
  EXPECT_EQ(mask.channels, 1);
  EXPECT_NEAR(mask.values[0], 1.0 - 0.5 * 0.05, 1e-6);
  EXPECT_NEAR(mask.values[9], 1.0 - 0.5 * 0.95, 1e-6);
}

TEST(WarpConversion, MaskMultipliesIntensitiesInLinearLight) {
  WarpMesh mesh = linear_mesh(2, 2);
  multiply_intensity(mesh, {2, 2, 1, 8, {0.5F, 1.0F, 0.5F, 1.0F}}, 2.0);
  EXPECT_NEAR(mesh.at(0, 0).intensity, 0.25, 1e-6);
  EXPECT_NEAR(mesh.at(1, 1).intensity, 0.5, 1e-6);
}

TEST(WarpConversion, CellsHeapedOverOneAnotherAreAnError) {
  // A mesh in which every cell covers the whole raster.
  WarpMesh heap = linear_mesh(200, 200);
  for (int row = 0; row < 200; ++row) {
    for (int column = 0; column < 200; ++column) {
      heap.at(column, row).x = column % 2 == 0 ? 0.0F : 1.0F;
      heap.at(column, row).y = row % 2 == 0 ? 0.0F : 1.0F;
    }
  }
  EXPECT_THAT(test::error_of([&] { resampled_warp(heap, 500, 500); }), HasSubstr("overlap more than 64 times"));
}

TEST(WarpConversion, TargetOfOneSampleIsAnError) {
  EXPECT_THAT(test::error_of([&] { resampled_warp(linear_mesh(2, 2), 1, 1); }), HasSubstr("1 x 1"));
}

}  // namespace
}  // namespace ergodome
