#include <gmock/gmock.h>

#include <array>
#include <fstream>
#include <initializer_list>
#include <iterator>

#include "content/show/reading/show_reader.h"
#include "kernels/core/error.h"
#include "render/frame/show_renderer.h"
#include "render/output/image_writer.h"
#include "render/passes/objects/object_meshes.h"
#include "tests/support/errors.h"
#include "tests/support/folder_test.h"
#include "tests/support/gl_driver.h"

namespace ergodome {
namespace {

class MeshImages : public test::FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    std::vector<std::uint8_t> rgb(3UL * 8 * 4);
    for (std::size_t i = 0; i < rgb.size(); ++i) {
      rgb[i] = static_cast<std::uint8_t>(37 * i);
    }
    write_png(folder_ / "skin.png", rgb, 8, 4);
  }

  [[nodiscard]] MeshImage inside(const std::string& bytes) const {
    return {"ship.glb, its image skin.png", std::make_shared<const std::string>(bytes), ""};
  }

  [[nodiscard]] std::string skin_bytes() const {
    std::ifstream stream(folder_ / "skin.png", std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  }
};

TEST_F(MeshImages, AreTheSameInsideAMeshsFileAsInOneOfTheirOwn) {
  const OverlayImage own = read_mesh_image({(folder_ / "skin.png").string(), nullptr, "ship.obj"});
  const OverlayImage within = read_mesh_image(inside(skin_bytes()));
  EXPECT_EQ(within.width, 8);
  EXPECT_EQ(within.height, 4);
  EXPECT_EQ(within.texels, own.texels);
}

//! Returns red, green, blue (as linear light) and alpha of a texel.
std::array<double, 4> texel_of(const OverlayImage& image, std::size_t number) {
  std::array<double, 4> texel{};
  for (std::size_t c = 0; c < 4; ++c) {
    texel.at(c) = static_cast<double>(image.texels.at(4 * number + c)) / 65535.0;
  }
  return texel;
}

TEST(MeshImage, KeepsItsColorsWhereItIsTransparent) {
  const std::string file = std::string(ERGODOME_TEST_DATA_DIR) + "/foreign/meshes/clear_left.png";
  const OverlayImage image = read_mesh_image({file, nullptr, "ship.gltf"});
  for (const std::size_t texel : {0UL, 1UL}) {
    const std::array<double, 4> is = texel_of(image, texel);
    EXPECT_EQ(is[0], 1.0);
    EXPECT_NEAR(is[1], 0.21586, 1e-4) << "sRGB 128 of 255";
    EXPECT_EQ(is[2], 0.0);
    EXPECT_EQ(is[3], texel == 0 ? 0.0 : 1.0);
  }
}

TEST(MeshImage, HasSixteenBitsWhereItsFileHas) {
  const std::string file = std::string(ERGODOME_TEST_DATA_DIR) + "/foreign/meshes/sixteen_bits.png";
  const std::array<double, 4> is = texel_of(read_mesh_image({file, nullptr, "ship.gltf"}), 0);
  // The file contains 0x8000, 0x4000 and 0x2000 of 65535, as sRGB values.
  EXPECT_NEAR(is[0], 0.21404, 2e-5);
  EXPECT_NEAR(is[1], 0.05088, 2e-5);
  EXPECT_NEAR(is[2], 0.01435, 2e-5);
}

TEST(MeshImage, MayBeWebpInsideAMeshOrBesideIt) {
  const std::string file = std::string(ERGODOME_TEST_DATA_DIR) + "/foreign/meshes/quad.webp";
  std::ifstream stream(file, std::ios::binary);
  const auto bytes =
      std::make_shared<const std::string>(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
  for (const MeshImage& image : {MeshImage{file, nullptr, "ship.gltf"}, MeshImage{"its image.webp", bytes, ""}}) {
    const std::array<double, 4> is = texel_of(read_mesh_image(image), 0);
    EXPECT_EQ(is[0], 1.0);
    EXPECT_NEAR(is[1], 0.21586, 1e-4) << "sRGB 128 of 255";
    EXPECT_EQ(is[2], 0.0);
  }
}

TEST_F(MeshImages, ThatAreTornAreErrorsWithTheMeshsName) {
  for (const std::string& bytes : {std::string("hello"), skin_bytes().substr(0, 60), std::string()}) {
    try {
      read_mesh_image(inside(bytes));
      ADD_FAILURE() << "was taken: " << bytes.size() << " bytes";
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("ship.glb"));
    }
  }
}

TEST_F(MeshImages, ThatAreTornFilesAreErrorsWithBothNamesAndTheRemedy) {
  std::ofstream(folder_ / "torn.png", std::ios::binary) << skin_bytes().substr(0, skin_bytes().size() - 20);
  const std::string problem = test::error_of([&] {
    read_mesh_image({(folder_ / "torn.png").string(), nullptr, "ship.obj"});
  });
  EXPECT_THAT(problem, testing::AllOf(testing::HasSubstr("torn.png: "), testing::HasSubstr("ship.obj"),
                                      testing::EndsWith("the file is truncated or damaged; save it again")));
}

//! Tests of images on polygons that OpenGL draws.
class PolygonImages : public MeshImages {
 protected:
  void SetUp() override {
    MeshImages::SetUp();
    test::driver_was_loaded = true;
  }
};

TEST_F(PolygonImages, AreNotSeenAroundTheirSides) {
  // The image is red on the left and blue on the right. It is on a square that faces the camera.
  std::vector<std::uint8_t> rgb;
  for (int i = 0; i < 64; ++i) {
    rgb.insert(rgb.end(), i % 8 < 4 ? std::initializer_list<std::uint8_t>{255, 0, 0}
                                    : std::initializer_list<std::uint8_t>{0, 0, 255});
  }
  write_png(folder_ / "halves.png", rgb, 8, 8);
  std::ofstream(folder_ / "q.mtl") << "newmtl halves\nKd 1 1 1\nmap_Kd halves.png\n";
  std::ofstream(folder_ / "q.obj")
      << "mtllib q.mtl\nv 0 -1 -1\nv 0 1 -1\nv 0 1 1\nv 0 -1 1\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
         "usemtl halves\nf 1/1 2/2 3/3 4/4\n";
  for (const char* const method : {"polygon", "trace"}) {
    std::ofstream(folder_ / "q.toml")
        << "[hole]\nspin = 0\n[[camera.key]]\nr = 30\n[view]\nprojection = \"pinhole\"\nfov_deg = 20\n"
           "size_px = 100\n[sky]\nmap = \"black\"\n[[objects]]\nmesh = \"q.obj\"\n"
           "position = [20, 0, 0]\nmethod = \""
        << method << "\"\n";
    ShowRenderer renderer(read_show(folder_ / "q.toml"), Backend::cpu);
    const PixelValues rgba = renderer.render(0.0, {}).front().picture.rgba;
    const auto light = [&](int x, std::size_t channel) {
      return rgba[4UL * (50UL * 100UL + static_cast<std::size_t>(x)) + channel];
    };
    double red_right = 0.0;
    double blue_left = 0.0;
    double all = 0.0;
    // Columns 25 to 74 contain only the first image of the square; the second image is farther from
    // the middle.
    for (int x = 25; x < 75; ++x) {
      (x < 40 ? blue_left : all) += static_cast<double>(light(x, 2));
      (x >= 60 ? red_right : all) += static_cast<double>(light(x, 0));
    }
    EXPECT_GT(all, 20.0) << method;
    EXPECT_EQ(blue_left, 0.0) << method;
    EXPECT_EQ(red_right, 0.0) << method;
  }
}

}  // namespace
}  // namespace ergodome
