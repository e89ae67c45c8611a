#include "content/mesh/formats/obj_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>

#include "content/mesh/formats/mesh_reader.h"
#include "content/mesh/formats/obj_materials.h"
#include "tests/support/errors.h"
#include "tests/support/folder_test.h"

// Tests with Wavefront OBJ files as other programs write them.
namespace ergodome {
namespace {

namespace fs = std::filesystem;
using test::error_of;
using testing::ElementsAre;
using testing::HasSubstr;

const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
const std::string textured = triangle + "vt 0 0\nvt 1 0\nvt 0 1\n";

TriangleMesh obj_mesh(const std::string& text) { return parse_mesh(text, MeshFormat::obj, "a.obj"); }

TEST(ObjReader, NumbersFromTheEndAndFromTheBeginningNameTheSameCorners) {
  const TriangleMesh mesh = obj_mesh(triangle + "f -3 -2 -1\nf 1 2 3\n");
  ASSERT_EQ(mesh.triangle_count(), 2);
  for (int i = 0; i < 3; ++i) {
    EXPECT_THAT(mesh.vertices[mesh.indices[static_cast<std::size_t>(i)]].position,
                testing::ElementsAreArray(mesh.vertices[mesh.indices[static_cast<std::size_t>(i + 3)]].position));
  }
}

TEST(ObjReader, LinesGoOnBehindABackslash) {
  EXPECT_EQ(obj_mesh("\xEF\xBB\xBFv 0 0 0\r\nv 1 0 \\\r\n0\r\nv 0 1 0\r\nf 1 \\\n2 \\\n3").triangle_count(), 1);
}

TEST(ObjReader, TakesColoursOfVerticesAsSrgb) {
  const TriangleMesh mesh = obj_mesh("v 0 0 0 1 0 0\nv 1 0 0 0 0.5 0\nv 0 1 0 1.0 0 0 1\nf 1 2 3\n");
  EXPECT_THAT(mesh.vertices[0].color, ElementsAre(1.0F, 0.0F, 0.0F));
  EXPECT_NEAR(mesh.vertices[1].color[1], 0.2140F, 1e-4F) << "what a display shows at half of its scale";
  EXPECT_THAT(mesh.vertices[2].color, ElementsAre(0.0F, 0.0F, 1.0F)) << "behind a weight";
  EXPECT_THAT(mesh.parts[0].color, ElementsAre(1.0F, 1.0F, 1.0F)) << "no material darkens them";
  EXPECT_THAT(obj_mesh(triangle + "f 1 2 3\n").parts[0].color, ElementsAre(0.6F, 0.6F, 0.6F));
}

TEST(ObjReader, SmoothsWithinSmoothingGroupsAndEverywhereWithoutThem) {
  // The faces are two triangles at a right angle, which share the edge between corners 1 and 2.
  const std::string roof = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
  const auto normal = [&](const std::string& faces) {
    return Vector3<double>{static_cast<double>(obj_mesh(roof + faces).vertices[0].normal[0]),
                           static_cast<double>(obj_mesh(roof + faces).vertices[0].normal[1]),
                           static_cast<double>(obj_mesh(roof + faces).vertices[0].normal[2])};
  };
  EXPECT_NEAR(normal("s off\nf 1 2 3\nf 2 1 4\n").z, 1.0, 1e-6);
  EXPECT_NEAR(normal("s 1\nf 1 2 3\ns 2\nf 2 1 4\n").z, 1.0, 1e-6);
  EXPECT_NEAR(normal("s 1\nf 1 2 3\nf 2 1 4\n").z, std::sqrt(0.5), 1e-6);
  EXPECT_NEAR(normal("f 1 2 3\nf 2 1 4\n").z, std::sqrt(0.5), 1e-6);
}

TEST(ObjReader, RefusesFacesOfManyCornersAtOnce) {
  std::string text;
  std::string face = "f";
  for (int i = 1; i <= 100'000; ++i) {
    text += "v " + std::to_string(i) + " " + std::to_string(i * i % 1000) + " 0\n";
    face += " " + std::to_string(i);
  }
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_THAT(
      error_of([&] { obj_mesh(text + face + "\n"); }),
      testing::AllOf(HasSubstr("a.obj:100001: has a face of more than 1024 corners"), HasSubstr("triangulated")));
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(2));
}

TEST(ObjTexture, HasTheNameBehindItsOptions) {
  const ObjTexture plain = obj_texture("old bark.png");
  EXPECT_EQ(plain.name, "old bark.png");
  const ObjTexture placed = obj_texture("-blendu on -s 2 3 -o 0.5 -clamp on -mm 0 1 \"old bark.png\"");
  EXPECT_EQ(placed.name, "old bark.png");
  EXPECT_THAT(placed.scale, ElementsAre(2.0, 3.0));
  EXPECT_THAT(placed.offset, ElementsAre(0.5, 0.0));
  EXPECT_TRUE(placed.clamp);
  EXPECT_EQ(obj_texture("-s 2 3d.png").name, "3d.png") << "a name that begins with a number";
  EXPECT_EQ(obj_texture("-bark.png").name, "-bark.png") << "a name that looks like an option";
}

class ObjFiles : public test::FolderTest {
 protected:
  void write(const std::string& name, const std::string& text) const {
    fs::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  [[nodiscard]] TriangleMesh read(const std::string& name) const { return read_mesh(folder_ / name); }
};

TEST_F(ObjFiles, PicturesAreFoundByWhateverPathAProgramWrote) {
  write("tex/skin one.png", "");
  write("a.obj", "mtllib a.mtl\n" + textured + "usemtl skin\nf 1/1 2/2 3/3\n");
  for (const char* const name : {"tex/skin one.png", "tex\\skin one.png", ".\\tex\\skin one.png",
                                 "\"tex\\skin one.png\"", "Tex\\Skin One.PNG", "-s 1 1 1 tex/skin one.png   "}) {
    write("a.mtl", std::string("newmtl skin\nmap_Kd ") + name + "\r\n");
    EXPECT_EQ(read("a.obj").parts.at(0).image.name, (folder_ / "tex/skin one.png").string()) << name;
  }
  write("skin.png", "");
  for (const char* const name :
       {"C:\\Users\\me\\tex\\skin.png", "/home/me/tex/skin.png", "\\\\server\\share\\skin.png"}) {
    write("a.mtl", std::string("newmtl skin\nmap_Kd ") + name + "\n");
    EXPECT_EQ(read("a.obj").parts.at(0).image.name, (folder_ / "skin.png").string()) << name;
  }
}

TEST_F(ObjFiles, LibrariesAreOneNameWithBlanksOrSeveralNames) {
  write("a.mtl", "\xEF\xBB\xBFnewmtl warm\nKd 0.5 0.25 0\n");
  write("b.mtl", "newmtl cold one\nKd 0 0 1\n");
  write("two words.mtl", "newmtl warm\nKd 0 1 0\n");
  write("a.obj", "mtllib a.mtl b.mtl\n" + triangle + "usemtl warm\nf 1 2 3\nusemtl cold one\nf 3 2 1\n");
  write("b.obj", "mtllib two words.mtl\n" + triangle + "usemtl warm\nf 1 2 3\n");
  const TriangleMesh several = read("a.obj");
  ASSERT_EQ(several.parts.size(), 2U);
  EXPECT_THAT(several.parts[0].color, ElementsAre(0.5F, 0.25F, 0.0F));
  EXPECT_THAT(several.parts[1].color, ElementsAre(0.0F, 0.0F, 1.0F));
  EXPECT_THAT(read("b.obj").parts.at(0).color, ElementsAre(0.0F, 1.0F, 0.0F));
}

TEST_F(ObjFiles, TexturesArePlacedAndClampedAsTheMaterialSays) {
  write("skin.png", "");
  write("a.mtl", "newmtl skin\nmap_Kd -s 2 4 1 -o 0.5 0.25 0 -clamp on skin.png\n");
  write("a.obj", "mtllib a.mtl\n" + textured + "usemtl skin\nf 1/1 2/2 3/3\n");
  const TriangleMesh mesh = read("a.obj");
  EXPECT_THAT(mesh.vertices[0].texture, ElementsAre(0.5F, 0.25F));
  EXPECT_THAT(mesh.vertices[1].texture, ElementsAre(2.5F, 0.25F));
  EXPECT_THAT(mesh.vertices[2].texture, ElementsAre(0.5F, 4.25F));
  EXPECT_EQ(mesh.parts[0].wrap_u, TextureWrap::clamp);
  EXPECT_THAT(mesh.parts[0].color, ElementsAre(1.0F, 1.0F, 1.0F)) << "a picture without Kd is as bright as it is";
}

TEST_F(ObjFiles, WhatOnlyGlowsIsDrawnAsItsGlow) {
  write("a.mtl", "newmtl lamp\nKd 0 0 0\nKe 0.5 0.25 0\nnewmtl both\nKd 1 1 1\nKe 1 1 1\n");
  write("a.obj", "mtllib a.mtl\n" + triangle + "usemtl lamp\nf 1 2 3\nusemtl both\nf 3 2 1\n");
  const TriangleMesh mesh = read("a.obj");
  EXPECT_THAT(mesh.parts.at(0).color, ElementsAre(0.5F, 0.25F, 0.0F));
  EXPECT_THAT(mesh.remarks, ElementsAre(HasSubstr("emissive")));
}

TEST_F(ObjFiles, OfOtherProgramsAreReadRight) {
  const fs::path foreign = fs::path(ERGODOME_TEST_DATA_DIR) / "foreign";
  for (const char* const mesh : {"backslash.obj", "trailing_blanks.obj"}) {
    const TriangleMesh read = read_mesh(foreign / "meshes" / mesh);
    ASSERT_EQ(read.parts.size(), 1U) << mesh;
    EXPECT_THAT(read.parts[0].image.name, testing::EndsWith("quad.png")) << mesh;
  }
  EXPECT_EQ(read_mesh(foreign / "meshes" / "mac_lines.obj").triangle_count(), 1);
  const TriangleMesh bytes = read_mesh(foreign / "meshes" / "byte_colors.obj");
  EXPECT_THAT(bytes.vertices[0].color, ElementsAre(1.0F, 0.0F, 0.0F));
  EXPECT_NEAR(bytes.vertices[1].color[1], 0.2159F, 1e-4F) << "sRGB 128 of 255";
  const TriangleMesh colours = read_mesh(foreign / "meshes" / "vertex_colors.obj");
  EXPECT_TRUE(std::ranges::any_of(colours.vertices, [](const SurfaceVertex& v) { return v.color[0] != v.color[1]; }));
}

TEST(ObjReader, RefusesIndicesBeforeTheFirst) {
  for (const char* const face : {"f -4 2 3", "f 1/-4 2/2 3/3", "f 1//-1 2//1 3//1", "f 1/9 2/2 3/3"}) {
    EXPECT_THAT(error_of([&] { obj_mesh(textured + face + "\n"); }), HasSubstr("nonexistent vertex")) << face;
  }
}

TEST(ObjReader, TexturesHaveCoordinatesWithDecimalPoints) {
  EXPECT_THAT(
      error_of([] { read_mesh(fs::path(ERGODOME_TEST_DATA_DIR) / "foreign" / "meshes" / "decimal_commas.obj"); }),
      HasSubstr("decimal_commas.obj:4: has texture coordinates that are not numbers"));
  const TriangleMesh mesh = obj_mesh(triangle + "vt 1.e-1 +2 # note\nvt -1.#QNAN nan\nvt .5\nf 1/1 2/2 3/3\n");
  EXPECT_THAT(mesh.vertices[0].texture, ElementsAre(0.1F, 2.0F));
  EXPECT_THAT(mesh.vertices[1].texture, ElementsAre(0.0F, 0.0F));
  EXPECT_THAT(mesh.vertices[2].texture, ElementsAre(0.5F, 0.0F));
}

TEST(ObjReader, RemarksOnWhatIsNoTriangle) {
  for (const char* const other : {"l 1 2 3", "p 1 2", "f 1 2"}) {
    EXPECT_THAT(obj_mesh(triangle + "f 1 2 3\n" + other + "\n").remarks, ElementsAre(HasSubstr("points or lines")))
        << other;
  }
  EXPECT_THAT(error_of([] { read_mesh(fs::path(ERGODOME_TEST_DATA_DIR) / "foreign" / "meshes" / "free_form.obj"); }),
              HasSubstr("has no triangles; it has free-form curves or surfaces"));
}

TEST_F(ObjFiles, MaterialsOfOldProgramsAreReadRight) {
  write("Gr\u00fcn.png", "");
  write("a.mtl", "newmtl Gr\xfcn\nKD 0 1 0\nmap_kd Gr\xfcn.png\n");
  write("a.obj", "mtllib a.mtl\n" + textured + "usemtl Gr\xfcn\nf 1/1 2/2 3/3\n");
  const TriangleMesh mesh = read("a.obj");
  EXPECT_THAT(mesh.parts.at(0).color, ElementsAre(0.0F, 1.0F, 0.0F));
  EXPECT_EQ(mesh.parts.at(0).image.name, (folder_ / "Gr\u00fcn.png").string());
  EXPECT_THAT(mesh.remarks, testing::IsEmpty());
}

TEST_F(ObjFiles, RemarksOnWhatOfAMaterialIsNotDrawn) {
  write("skin.png", "");
  write("a.obj", "mtllib a.mtl\n" + textured + "usemtl skin\nf 1/1 2/2 3/3\n");
  const auto remarks = [&](const std::string& statements) {
    write("a.mtl", "newmtl skin\n" + statements + "\n");
    return read("a.obj").remarks;
  };
  EXPECT_THAT(remarks("Kd 1 1 1\nd -halo 0.5"), ElementsAre(HasSubstr("drawn opaque")));
  EXPECT_THAT(remarks("Kd 1 1 1\nTr 0.5"), ElementsAre(HasSubstr("drawn opaque")));
  EXPECT_THAT(remarks("Kd 1 1 1\nmap_d skin.png"), ElementsAre(HasSubstr("drawn opaque")));
  EXPECT_THAT(remarks("Kd 1 1 1\nd 1\nTr 0\nillum 2"), testing::IsEmpty());
  EXPECT_THAT(remarks("Kd 0,5 0,5 0,5"), ElementsAre(HasSubstr("decimal points")));
  EXPECT_THAT(remarks("Kd spectral red.rfl"), ElementsAre(HasSubstr("decimal points")));
  EXPECT_THAT(remarks("Kd 0 0 0\nmap_Kd skin.png"), ElementsAre(HasSubstr("material color is black")));
  EXPECT_THAT(remarks("Kd 0.5 # grey\nmap_Kd skin.png"), testing::IsEmpty());
}

TEST_F(ObjFiles, AGlowMayBeBrighterThanWhite) {
  write("a.mtl", "newmtl lamp\nKd 0 0 0\nKe 5 2.5 0\n");
  write("a.obj", "mtllib a.mtl\n" + triangle + "usemtl lamp\nf 1 2 3\n");
  EXPECT_THAT(read("a.obj").parts.at(0).color, ElementsAre(5.0F, 2.5F, 0.0F));
}

}  // namespace
}  // namespace ergodome
