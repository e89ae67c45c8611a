#include <gmock/gmock.h>

#include <fstream>
#include <iterator>

#include "kernels/core/error.h"
#include "render/objects/object_meshes.h"
#include "render/output/image_writer.h"
#include "tests/support/folder_test.h"

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
    return {"ship.glb, its image skin.png", std::make_shared<const std::string>(bytes)};
  }

  [[nodiscard]] std::string skin_bytes() const {
    std::ifstream stream(folder_ / "skin.png", std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  }
};

TEST_F(MeshImages, AreTheSameInsideAMeshsFileAsInOneOfTheirOwn) {
  const OverlayImage own = read_mesh_image({(folder_ / "skin.png").string(), nullptr});
  const OverlayImage within = read_mesh_image(inside(skin_bytes()));
  EXPECT_EQ(within.width, 8);
  EXPECT_EQ(within.height, 4);
  EXPECT_EQ(within.texels, own.texels);
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

}  // namespace
}  // namespace ergodome
