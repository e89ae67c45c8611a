#include "kernels/sky/cube_map.h"

#include <ImfChannelList.h>
#include <ImfEnvmap.h>
#include <ImfEnvmapAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "content/sky/environment_image.h"
#include "tests/support/errors.h"
#include "tests/support/folder_test.h"

namespace ergodome {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr int side = 64;

using Axis = std::array<double, 3>;

//! A cell of an image that contains a face of the cube. `middle`, `right` and `down` are the
//! directions of the face's center, right edge and lower edge, as (right, up, forward) of a viewer
//! inside the cube.
struct Cell {
  int column, row;
  Axis middle, right, down;
};

constexpr Axis to_right = {1, 0, 0};
constexpr Axis to_left = {-1, 0, 0};
constexpr Axis upward = {0, 1, 0};
constexpr Axis downward = {0, -1, 0};
constexpr Axis forward = {0, 0, 1};
constexpr Axis backward = {0, 0, -1};

//! Returns the color of the test sky in a direction. It varies smoothly and is different in every
//! direction.
std::array<float, 3> color_of(const Axis& direction) {
  const double length = std::hypot(direction[0], direction[1], direction[2]);
  return {static_cast<float>(1.0 + direction[0] / length), static_cast<float>(1.0 + direction[1] / length),
          static_cast<float>(1.0 + direction[2] / length)};
}

class CubeMaps : public test::FolderTest {
 protected:
  fs::path write(const std::string& name, int width, int height, const std::vector<float>& rgb) {
    fs::path path = folder_ / name;
    const auto output = OIIO::ImageOutput::create(path.string());
    EXPECT_TRUE(output && output->open(path.string(), OIIO::ImageSpec(width, height, 3, OIIO::TypeDesc::FLOAT)) &&
                output->write_image(OIIO::TypeDesc::FLOAT, rgb.data()) && output->close())
        << OIIO::geterror();
    return path;
  }

  fs::path write_cells(int columns, int rows, const std::vector<Cell>& cells) {
    const int width = columns * side;
    std::vector<float> rgb(static_cast<std::size_t>(3 * width * rows * side));
    for (const Cell& cell : cells) {
      for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
          const double s = 2.0 * (x + 0.5) / side - 1.0;
          const double t = 2.0 * (y + 0.5) / side - 1.0;
          Axis direction{};
          for (std::size_t i = 0; i < 3; ++i) {
            direction.at(i) = cell.middle.at(i) + s * cell.right.at(i) + t * cell.down.at(i);
          }
          const auto color = color_of(direction);
          std::ranges::copy(color, rgb.begin() + 3 * ((cell.row * side + y) * width + cell.column * side + x));
        }
      }
    }
    return write("cube.exr", width, rows * side, rgb);
  }

  //! Compares an equirectangular map with the test sky; returns the maximum difference of the
  //! colors.
  static float worst_difference(const EnvironmentImage& image) {
    float worst = 0.0F;
    for (int y = 0; y < image.height; ++y) {
      const double latitude = std::numbers::pi * (0.5 - (y + 0.5) / image.height);
      for (int x = 0; x < image.width; ++x) {
        const double longitude = 2.0 * std::numbers::pi * ((x + 0.5) / image.width - 0.5);
        const auto expected = color_of(
            {std::cos(latitude) * std::sin(longitude), std::sin(latitude), std::cos(latitude) * std::cos(longitude)});
        for (int c = 0; c < 3; ++c) {
          const std::size_t texel =
              static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x);
          worst = std::max(worst, std::abs(image.rgb.at(3 * texel + static_cast<std::size_t>(c)) -
                                           expected.at(static_cast<std::size_t>(c))));
        }
      }
    }
    return worst;
  }
};

//! Tolerance for the difference of colors: the change of the test sky over half a texel at the edge
//! of a face.
constexpr float tolerance = 1.2F / side;

//! Returns the faces of an OpenGL cube map in their order: +X, -X, +Y, -Y, +Z, -Z. The axes X, Y
//! and Z are right, up and forward (OpenGL 4.6, table 8.19).
std::vector<Cell> opengl_faces(bool in_a_row) {
  std::vector<Cell> cells = {{0, 0, to_right, backward, downward}, {1, 0, to_left, forward, downward},
                             {2, 0, upward, to_right, forward},    {3, 0, downward, to_right, backward},
                             {4, 0, forward, to_right, downward},  {5, 0, backward, to_left, downward}};
  for (Cell& cell : cells) {
    if (!in_a_row) {
      std::swap(cell.column, cell.row);
    }
  }
  return cells;
}

TEST_F(CubeMaps, InARowOrAColumnAreTheSky) {
  const EnvironmentImage row = read_environment_image(write_cells(6, 1, opengl_faces(true)));
  EXPECT_EQ(row.width, 4 * side);
  EXPECT_EQ(row.height, 2 * side);
  EXPECT_LT(worst_difference(row), tolerance);
  EXPECT_LT(worst_difference(read_environment_image(write_cells(1, 6, opengl_faces(false)))), tolerance);
}

TEST_F(CubeMaps, AsCrossesAreTheSky) {
  std::vector<Cell> cells = {{0, 1, to_left, forward, downward},   {1, 1, forward, to_right, downward},
                             {2, 1, to_right, backward, downward}, {3, 1, backward, to_left, downward},
                             {1, 0, upward, to_right, forward},    {1, 2, downward, to_right, backward}};
  EXPECT_LT(worst_difference(read_environment_image(write_cells(4, 3, cells))), tolerance);
  // In an upright cross, the back face is below the bottom face and upside down.
  cells[3] = {1, 3, backward, to_right, upward};
  EXPECT_LT(worst_difference(read_environment_image(write_cells(3, 4, cells))), tolerance);
}

TEST_F(CubeMaps, OfOpenExrAreTheSky) {
  // Expected values come from OpenEXR's functions for cube maps and for latitude-longitude maps.
  const Imath::Box2i window({0, 0}, {side - 1, 6 * side - 1});
  std::vector<float> rgb(3UL * side * side * 6);
  for (int face = 0; face < 6; ++face) {
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        const Imath::V2f in_face(static_cast<float>(x), static_cast<float>(y));
        const auto name = static_cast<Imf::CubeMapFace>(face);
        const Imath::V2f pixel = Imf::CubeMap::pixelPosition(name, window, in_face);
        const Imath::V3f direction = Imf::CubeMap::direction(name, window, in_face);
        const Imath::V2f lat_long = Imf::LatLongMap::latLong(direction);
        // In OpenEXR's latitude-longitude maps, longitudes decrease from the left edge to the right
        // edge.
        const double longitude = -static_cast<double>(lat_long.y);
        const double latitude = static_cast<double>(lat_long.x);
        const auto color = color_of(
            {std::cos(latitude) * std::sin(longitude), std::sin(latitude), std::cos(latitude) * std::cos(longitude)});
        const auto at = 3 * (std::lround(pixel.y) * side + std::lround(pixel.x));
        std::ranges::copy(color, rgb.begin() + at);
      }
    }
  }
  const fs::path path = folder_ / "envmap.exr";
  Imf::Header header(side, 6 * side);
  Imf::addEnvmap(header, Imf::ENVMAP_CUBE);
  Imf::FrameBuffer pixels;
  const char* const names[] = {"R", "G", "B"};
  for (std::size_t c = 0; c < 3; ++c) {
    header.channels().insert(names[c], Imf::Channel(Imf::FLOAT));
    pixels.insert(names[c], Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(rgb.data() + c), 3 * sizeof(float),
                                       3 * sizeof(float) * side));
  }
  {
    Imf::OutputFile file(path.c_str(), header);
    file.setFrameBuffer(pixels);
    file.writePixels(6 * side);
  }
  EXPECT_LT(worst_difference(read_environment_image(path)), 2.0F * tolerance);
}

TEST_F(CubeMaps, OtherImagesOfTheSameShapeAreRefused) {
  std::vector<float> photograph;
  photograph.reserve(std::size_t{3} * 4 * side * 3 * side);
  for (int i = 0; i < 3 * 4 * side * 3 * side; ++i) {
    photograph.push_back(0.3F + 0.2F * std::sin(0.05F * static_cast<float>(i)));
  }
  for (const auto& [width, height] : {std::pair{4 * side, 3 * side}, std::pair{3 * side, 4 * side}}) {
    const fs::path path = write("photograph.exr", width, height, photograph);
    EXPECT_THAT(test::error_of([&] { read_environment_image(path); }),
                HasSubstr("neither twice as wide as high nor a cube map"));
  }
}

}  // namespace
}  // namespace ergodome
