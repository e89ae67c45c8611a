#include "content/mesh/formats/mesh_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>

#include "content/mesh/named_file.h"
#include "content/mesh/triangle_mesh.h"
#include "tests/support/errors.h"
#include "tests/support/folder_test.h"

namespace ergodome {
namespace {

using test::error_of;

constexpr const char* square_obj = R"(# a square of two triangles and one triangle that is a line
v 0 0 0
v 2 0 0
v 2 2 0
v 0 2 0
vt 0 0
vt 1 0
vt 1 1
vt 0 1
f 1/1 2/2 3/3 4/4
f 1/1 3/3 3/3
)";

TEST(MeshReader, ReadsAnObjAndDropsTrianglesWithoutArea) {
  const TriangleMesh mesh = parse_mesh(square_obj, MeshFormat::obj, "square.obj");
  EXPECT_EQ(mesh.triangle_count(), 2);
  EXPECT_EQ(mesh.dropped_triangles, 1);
  for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
    const SurfaceVertex& vertex = mesh.vertices[mesh.indices[i]];
    EXPECT_FLOAT_EQ(vertex.normal[2], 1.0F);
    EXPECT_FLOAT_EQ(vertex.texture[0], 0.5F * vertex.position[0]);
    EXPECT_FLOAT_EQ(vertex.texture[1], 0.5F * vertex.position[1]);
  }
}

TEST(MeshReader, SaysWhatIsWrongWithTheFileAndWhatToDo) {
  for (const auto& wrong : std::map<std::string, std::string>{
           {"", "mesh.obj"},
           {"v 0 0 0\n", "mesh.obj"},
           {"v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", "has only 1 triangle without area"},
           {"v 0 0 0\nv 1 0 0\nv nan 1 0\nf 1 2 3\n", "mesh.obj:4: has a vertex with a non-finite coordinate"},
           {"f 1 2 3\n", "mesh.obj:1: has a face that refers to a nonexistent vertex"},
           {"v 0 0 0\nv 1 0 0\nf 1 2 900000\n", "mesh.obj:3: has a face that refers to a nonexistent vertex"},
           {"v 0 0\n", "mesh.obj:1: has a vertex with fewer than three valid coordinates"},
           {"v 0 0 0\nf 1 x 1\n", "mesh.obj:2: has a face whose vertex index is not a whole number"}}) {
    EXPECT_THAT(error_of([&] { parse_mesh(wrong.first, MeshFormat::obj, "mesh.obj"); }),
                testing::AllOf(testing::HasSubstr(wrong.second), testing::HasSubstr("; ")))
        << wrong.first;
  }
  for (const char* const text : {"", "{", "{}", R"({"asset":{"version":"2.0"}})", R"({"asset":{"version":"9.0"}})"}) {
    EXPECT_THAT(error_of([&] { parse_mesh(text, MeshFormat::gltf, "mesh.gltf"); }), testing::HasSubstr("mesh.gltf: "))
        << text;
    EXPECT_THAT(error_of([&] { parse_mesh(text, MeshFormat::glb, "mesh.glb"); }), testing::HasSubstr("mesh.glb: "))
        << text;
  }
}

TEST(MeshReader, NormalsThatAreNoneAreThoseOfTheFaces) {
  for (const char* const normal : {"0 0 0", "nan nan nan", "inf 0 0"}) {
    const std::string text = std::string("v 0 0 0\nv 2 0 0\nv 0 2 0\nvn ") + normal + "\nf 1//1 2//1 3//1\n";
    const TriangleMesh mesh = parse_mesh(text, MeshFormat::obj, "mesh.obj");
    for (const std::uint32_t index : mesh.indices) {
      EXPECT_THAT(mesh.vertices[index].normal, testing::ElementsAre(0.0F, 0.0F, 1.0F)) << normal;
    }
  }
}

TEST(MeshReader, NormalsThatAreGivenStayBesideThoseThatAreNone) {
  const TriangleMesh mesh =
      parse_mesh("v 0 0 0\nv 2 0 0\nv 0 2 0\nvn 0 0 0\nvn 1 0 0\nf 1//1 2//2 3//1\n", MeshFormat::obj, "mesh.obj");
  int given = 0;
  for (const std::uint32_t index : mesh.indices) {
    const SurfaceVertex& vertex = mesh.vertices[index];
    const bool second = vertex.position[0] > 1.0F;
    given += second ? 1 : 0;
    EXPECT_EQ(vertex.normal[0], second ? 1.0F : 0.0F);
    EXPECT_EQ(vertex.normal[2], second ? 0.0F : 1.0F);
  }
  EXPECT_EQ(given, 1);
}

TEST(MeshReader, SaysThatAnObjBreaksOffWithinAFace) {
  const std::string whole = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4";
  EXPECT_EQ(parse_mesh(whole, MeshFormat::obj, "mesh.obj").triangle_count(), 2) << "the last line needs no end";
  EXPECT_THAT(error_of([&] { parse_mesh(whole.substr(0, whole.size() - 2), MeshFormat::obj, "mesh.obj"); }),
              testing::HasSubstr("mesh.obj:6: ends in the middle of a face"));
}

class MeshFilesOnDisk : public test::FolderTest {
 protected:
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
};

TEST_F(MeshFilesOnDisk, AnObjHasTheColoursAndImagesOfItsMaterials) {
  write("a.mtl", "newmtl warm\nKd 0.5 0.25 0\nmap_Kd skin.png\nnewmtl cold\nKd 0 0 1\n");
  write("skin.png", "");
  write("a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl warm\nf 1 2 3\nusemtl cold\nf 3 2 1\n");
  const TriangleMesh mesh = read_mesh(folder_ / "a.obj");
  ASSERT_EQ(mesh.parts.size(), 2U);
  EXPECT_THAT(mesh.parts[0].color, testing::ElementsAre(0.5F, 0.25F, 0.0F));
  EXPECT_EQ(mesh.parts[0].image.name, (folder_ / "skin.png").string());
  EXPECT_THAT(mesh.parts[1].color, testing::ElementsAre(0.0F, 0.0F, 1.0F));
  EXPECT_TRUE(mesh.parts[1].image.empty());
}

TEST_F(MeshFilesOnDisk, RemarksOnAMaterialThatItsFilesDoNotHave) {
  write("a.mtl", "newmtl warm\nKd 0.5 0.25 0\n");
  write("a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl warm\nf 1 2 3\nusemtl  cold one \nf 3 2 1\n");
  EXPECT_THAT(read_mesh(folder_ / "a.obj").remarks,
              testing::ElementsAre(testing::HasSubstr("no material file defines (\"cold one\")")));
}

TEST_F(MeshFilesOnDisk, RemarksOnAPictureWithoutPlacesOnIt) {
  write("a.mtl", "newmtl warm\nmap_Kd skin.png\n");
  write("skin.png", "");
  write("a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl warm\nf 1 2 3\n");
  EXPECT_THAT(read_mesh(folder_ / "a.obj").remarks,
              testing::ElementsAre(testing::HasSubstr("they show a single texel of skin.png")));
}

TEST_F(MeshFilesOnDisk, RemarksOnMaterialsThatAreTransparent) {
  write("a.mtl", "newmtl glass\nKd 1 1 1\nd 0.3\nnewmtl steel\nKd 1 1 1\nd 1\n");
  write("a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl glass\nf 1 2 3\n");
  write("b.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl steel\nf 1 2 3\n");
  EXPECT_THAT(read_mesh(folder_ / "a.obj").remarks, testing::ElementsAre(testing::HasSubstr("drawn opaque")));
  EXPECT_THAT(read_mesh(folder_ / "b.obj").remarks, testing::IsEmpty());
}

TEST_F(MeshFilesOnDisk, AGltfIsReadWithItsBufferAndWhereItsNodeStands) {
  const float corners[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  std::ofstream(folder_ / "b.bin", std::ios::binary).write(reinterpret_cast<const char*>(corners), sizeof corners);
  write("b.gltf", R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
    "nodes":[{"mesh":0,"translation":[0,0,5]}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],
    "materials":[{"pbrMetallicRoughness":{"baseColorFactor":[0.25,0.5,0.75,1]}}],
    "buffers":[{"uri":"b.bin","byteLength":36}],"bufferViews":[{"buffer":0,"byteLength":36}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}]})");
  const TriangleMesh mesh = read_mesh(folder_ / "b.gltf");
  ASSERT_EQ(mesh.triangle_count(), 1);
  EXPECT_EQ(mesh.vertices[0].position[2], 5.0F);
  EXPECT_THAT(mesh.parts.front().color, testing::ElementsAre(0.25F, 0.5F, 0.75F));
  std::filesystem::remove(folder_ / "b.bin");
  EXPECT_THAT(error_of([&] { read_mesh(folder_ / "b.gltf"); }), testing::HasSubstr("b.gltf: "));
}

//! Returns the text of a glTF file with a textured triangle. `image` is the JSON of the image for
//! its texture.
std::string gltf_with_image(const std::string& image) {
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
    "meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1},"material":0}]}],
    "materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],"textures":[{"source":0}],"images":[)" +
         image + R"(],
    "buffers":[{"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/","byteLength":60}],
    "bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":24},
      {"buffer":0,"byteOffset":0,"byteLength":16}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
      {"bufferView":1,"componentType":5126,"count":3,"type":"VEC2"}]})";
}

TEST(MeshReader, KeepsTheBytesOfAnImageInsideTheFile) {
  const TriangleMesh coded =
      parse_mesh(gltf_with_image(R"({"uri":"data:image/png;base64,aGVsbG8="})"), MeshFormat::gltf, "a.gltf");
  ASSERT_TRUE(coded.parts.front().image.bytes);
  EXPECT_EQ(*coded.parts.front().image.bytes, "hello");
  EXPECT_THAT(coded.parts.front().image.name, testing::AllOf(testing::StartsWith("a.gltf"), testing::EndsWith(".png")));
  const TriangleMesh viewed =
      parse_mesh(gltf_with_image(R"({"bufferView":2,"mimeType":"image/jpeg"})"), MeshFormat::gltf, "a.gltf");
  ASSERT_TRUE(viewed.parts.front().image.bytes);
  EXPECT_EQ(viewed.parts.front().image.bytes->size(), 16U);
  EXPECT_THAT(viewed.parts.front().image.name, testing::EndsWith(".jpg"));
}

//! Returns `text` with the first occurrence of `part`, which must exist, replaced by `other`.
std::string with(std::string text, const std::string& part, const std::string& other) {
  return text.replace(text.find(part), part.size(), other);
}

TEST(MeshReader, TellsImagesInsideTheFileApartThatHaveNoNames) {
  const std::string image = R"({"uri":"data:image/png;base64,aGVsbG8="})";
  std::string text = with(gltf_with_image(image + "," + image), R"("textures":[{"source":0}])",
                          R"("textures":[{"source":0},{"source":1}])");
  text = with(text, R"("material":0}])", R"("material":0},{"attributes":{"POSITION":0,"TEXCOORD_0":1},"material":1}])");
  text = with(text, R"("materials":[)", R"("materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":1}}},)");
  const TriangleMesh mesh = parse_mesh(text, MeshFormat::gltf, "a.gltf");
  ASSERT_EQ(mesh.parts.size(), 2U);
  EXPECT_NE(mesh.parts[0].image.name, mesh.parts[1].image.name);
}

TEST(MeshReader, HeedsTheAlphaOfAGltfMaterialOnlyWhereItsModeDoes) {
  const std::string text = with(gltf_with_image(R"({"uri":"data:image/png;base64,aGVsbG8="})"),
                                R"("baseColorTexture":{"index":0}}})", R"("baseColorFactor":[1,1,1,0.25]}})");
  EXPECT_THAT(parse_mesh(text, MeshFormat::gltf, "a.gltf").remarks, testing::IsEmpty());
  EXPECT_THAT(parse_mesh(with(text, "0.25]}}", R"(0.25]},"alphaMode":"BLEND"})"), MeshFormat::gltf, "a.gltf").remarks,
              testing::ElementsAre(testing::HasSubstr("drawn opaque")));
}

TEST(MeshNormals, AreTheFirstFacesWhereFacesCancelOut) {
  TriangleMesh mesh;
  mesh.vertices = {{{0, 0, 0}, {0, 0, 0}, {0, 0}}, {{1, 0, 0}, {0, 0, 0}, {0, 0}}, {{0, 1, 0}, {0, 0, 0}, {0, 0}}};
  mesh.indices = {0, 1, 2, 0, 2, 1};
  repair_normals(mesh);
  for (const SurfaceVertex& vertex : mesh.vertices) {
    EXPECT_THAT(vertex.normal, testing::ElementsAre(0.0F, 0.0F, 1.0F));
  }
}

TEST(MeshReader, RefusesAnImageInsideTheFileOfNoKnownKind) {
  EXPECT_THAT(error_of([] {
                parse_mesh(gltf_with_image(R"({"bufferView":2,"mimeType":"image/../x"})"), MeshFormat::gltf, "a.gltf");
              }),
              testing::HasSubstr("in an unsupported format"));
}

TEST_F(MeshFilesOnDisk, NamesOfAGltfMayBeUris) {
  write("skin t\u00fcr.png", "");
  write("d.gltf", gltf_with_image(R"({"uri":"skin%20t%C3%BCr.png"})"));
  EXPECT_EQ(read_mesh(folder_ / "d.gltf").parts.front().image.name, (folder_ / "skin t\u00fcr.png").string());
  EXPECT_EQ(file_of_mesh(folder_, "skin%20t\u00fcr.png"), folder_ / "skin t\u00fcr.png");
  write("50%.png", "");
  EXPECT_EQ(file_of_mesh(folder_, "50%.png"), folder_ / "50%.png");
  EXPECT_EQ(file_of_mesh(folder_, "50%25.png"), folder_ / "50%.png");
  EXPECT_EQ(file_of_mesh(folder_ / "inside", "%2e%2e/50%25.png"), "");
  EXPECT_EQ(file_of_mesh(folder_, "%2Fetc%2Fpasswd"), "");
}

TEST_F(MeshFilesOnDisk, NothingOutsideTheFolderIsNamed) {
  write("c.mtl", "newmtl far\nmap_Kd ../../etc/image.png\n");
  write("c.obj", "mtllib c.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl far\nf 1 2 3\n");
  EXPECT_THAT(error_of([&] { read_mesh(folder_ / "c.obj"); }), testing::HasSubstr("outside its folder"));
}

TEST_F(MeshFilesOnDisk, MaterialsThatAreNotThereAreAnErrorThatNamesThem) {
  write("d.obj", "mtllib colours.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl warm\nf 1 2 3\n");
  EXPECT_THAT(
      error_of([&] { read_mesh(folder_ / "d.obj"); }),
      testing::AllOf(testing::HasSubstr("d.obj: refers to \"colours.mtl\""), testing::HasSubstr("put the file there")));
  write("colours.mtl", "newmtl warm\nKd 0.5 0.25 0\n");
  EXPECT_THAT(read_mesh(folder_ / "d.obj").parts.front().color, testing::ElementsAre(0.5F, 0.25F, 0.0F));
}

TEST_F(MeshFilesOnDisk, AnImageThatIsNotThereIsAnErrorThatNamesIt) {
  write("d.mtl", "newmtl skin\nmap_Kd no.png\n");
  write("d.obj", "mtllib d.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl skin\nf 1 2 3\n");
  write("d.gltf", gltf_with_image(R"({"uri":"no.png"})"));
  for (const std::string mesh : {"d.obj", "d.gltf"}) {
    EXPECT_THAT(
        error_of([&] { read_mesh(folder_ / mesh); }),
        testing::AllOf(testing::HasSubstr(mesh + ": refers to \"no.png\""), testing::HasSubstr("put the file there")));
  }
}

TEST_F(MeshFilesOnDisk, WhatAMeshNamesIsFoundWithoutReadingIt) {
  write("e.obj", "  mtllib e.mtl\r\n# mtllib f.mtl\nv 0 0 0\n");
  write("e.mtl", "newmtl bark\nmap_Kd -s 2 2 1 old bark.png\nmap_Ks gone.png\n");
  write("f.mtl", "");
  write("old bark.png", "");
  EXPECT_THAT(files_of_mesh(folder_ / "e.obj"),
              testing::UnorderedElementsAre(folder_ / "e.mtl", folder_ / "old bark.png"));
  write("e.gltf", R"({"buffers": [{"uri": "e.bin"}, {"uri": "data:text/plain;base64,AAAA"}],
                      "images": [{"uri" : "old%20bark.png"}, {"uri": "../out.png"}]})");
  write("e.bin", "");
  EXPECT_THAT(files_of_mesh(folder_ / "e.gltf"),
              testing::UnorderedElementsAre(folder_ / "e.bin", folder_ / "old bark.png"));
  EXPECT_THAT(files_of_mesh(folder_ / "none.obj"), testing::IsEmpty());
}

TEST_F(MeshFilesOnDisk, AMissingFileAndAnotherKindAreErrorsWithARemedy) {
  EXPECT_THAT(error_of([&] { read_mesh(folder_ / "none.obj"); }), testing::HasSubstr("none.obj: "));
  write("d.stl", "solid\n");
  EXPECT_THAT(error_of([&] { read_mesh(folder_ / "d.stl"); }),
              testing::AllOf(testing::HasSubstr("not a supported mesh format"), testing::HasSubstr("glTF 2")));
}

}  // namespace
}  // namespace ergodome
