#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <vector>

#include "content/mesh/built_in_meshes.h"
#include "content/mesh/mesh_files.h"
#include "content/mesh/mesh_reader.h"
#include "content/mesh/named_file.h"
#include "content/mesh/triangle_boxes.h"
#include "kernels/core/angles.h"
#include "kernels/core/error.h"
#include "tests/support/folder_test.h"
#include "tests/support/sanitized.h"

namespace ergodome {
namespace {

Vector3<double> position(const TriangleMesh& mesh, std::size_t index) {
  const float(&p)[3] = mesh.vertices[mesh.indices[index]].position;
  return {p[0], p[1], p[2]};
}

//! Six times the volume that the triangles enclose: positive where they run counterclockwise as seen from outside.
double signed_volume(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    sum += dot(position(mesh, i), cross(position(mesh, i + 1), position(mesh, i + 2)));
  }
  return sum / 6.0;
}

//! How often each edge is run through one way less the other: 0 for all in a surface without a border.
bool is_closed(const TriangleMesh& mesh) {
  const auto key = [](const Vector3<double>& v) {
    return std::array{std::lround(v.x * 1e4), std::lround(v.y * 1e4), std::lround(v.z * 1e4)};
  };
  std::map<std::pair<std::array<long, 3>, std::array<long, 3>>, int> edges;
  for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
    const std::size_t next = i % 3 == 2 ? i - 2 : i + 1;
    const auto from = key(position(mesh, i));
    const auto to = key(position(mesh, next));
    ++edges[{from, to}];
    --edges[{to, from}];
  }
  return std::ranges::all_of(edges, [](const auto& edge) { return edge.second == 0; });
}

std::string reason_of(const std::function<void()>& what) {
  try {
    what();
  } catch (const Error& error) {
    return error.what();
  }
  return "was taken";
}

TEST(BuiltInMeshes, TheSphereOfMuellerSchulzAndWeiskopfHas1224TrianglesAndEnclosesABall) {
  const TriangleMesh mesh = make_sphere({});
  EXPECT_EQ(mesh.triangle_count(), 1224);
  EXPECT_EQ(mesh.dropped_triangles, 0);
  EXPECT_TRUE(is_closed(mesh));
  EXPECT_EQ(mesh.parts.front().index_count, mesh.indices.size());
  EXPECT_NEAR(signed_volume(make_sphere({256, 128})), 4.0 / 3.0 * pi, 2e-3);
  EXPECT_NEAR(radius_of(mesh), 1.0, 1e-6);
}

TEST(BuiltInMeshes, TheThickDiskHas2560TrianglesInThreeColoursAndEnclosesItsVolume) {
  const DiskShape shape;
  const TriangleMesh mesh = make_disk(shape);
  EXPECT_EQ(mesh.triangle_count(), 2560);
  EXPECT_TRUE(is_closed(mesh));
  ASSERT_EQ(mesh.parts.size(), 3U);
  EXPECT_EQ(std::set({mesh.parts[0].color, mesh.parts[1].color, mesh.parts[2].color}).size(), 3U);
  // Of a prism with 64 sides.
  const double ring = 0.5 * shape.segments * std::sin(2.0 * pi / shape.segments);
  const double volume = ring * (shape.outer * shape.outer - shape.inner * shape.inner) * shape.thickness;
  EXPECT_NEAR(signed_volume(mesh), volume, 1e-4 * volume);
}

TEST(BuiltInMeshes, NormalsPointTheWayThatTrianglesFace) {
  for (const TriangleMesh& mesh : {make_sphere({}), make_disk({}), make_triangle({})}) {
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
      const Vector3<double> face =
          cross(position(mesh, i + 1) - position(mesh, i), position(mesh, i + 2) - position(mesh, i));
      const float(&n)[3] = mesh.vertices[mesh.indices[i]].normal;
      const Vector3<double> normal{n[0], n[1], n[2]};
      ASSERT_NEAR(dot(normal, normal), 1.0, 1e-6);
      ASSERT_GT(dot(face, normal), 0.9 * std::sqrt(dot(face, face)));
    }
  }
}

TEST(BuiltInMeshes, RefuseATriangleOnALine) {
  const TriangleShape line{{{{0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}, {3.0, 3.0, 3.0}}}};
  EXPECT_THAT(reason_of([&] { make_triangle(line); }), testing::HasSubstr("on one line"));
}

TEST(BuiltInMeshes, HoldTenMillionTriangles) {
  const TriangleMesh mesh = make_sphere({3163, 1582});
  EXPECT_GT(mesh.triangle_count(), 10'000'000);
  EXPECT_EQ(mesh.parts.front().index_count, mesh.indices.size());
}

//! Looks at a tree from a node on: whether its box holds what is below it; counts the triangles of its leaves.
bool boxes_hold(const TriangleBoxes& tree, std::size_t at, int depth, std::vector<int>& met) {
  const TreeNode& node = tree.nodes[at];
  bool holds = depth <= deepest_tree;
  for (std::uint32_t i = 0; i < node.count; ++i) {
    const std::size_t place = node.first + i;
    ++met[tree.triangles[place]];
    for (std::size_t corner = 0; corner < 9; ++corner) {
      const float value = tree.corners[9 * place + corner];
      holds = holds && value >= node.low[corner % 3] && value <= node.high[corner % 3];
    }
  }
  for (std::size_t child = 0; child < 2 && node.count == 0; ++child) {
    const TreeNode& below = tree.nodes[node.first + child];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      holds = holds && below.low[axis] >= node.low[axis] && below.high[axis] <= node.high[axis];
    }
    holds = boxes_hold(tree, node.first + child, depth + 1, met) && holds;
  }
  return holds;
}

TEST(TriangleTrees, OfFewAndOfManyTrianglesHoldEachOfThemOnce) {
  // Those of many are made in parts, by several threads.
  for (const SphereShape& shape :
       {SphereShape{12, 6}, SphereShape{90, 45}, test::sanitized ? SphereShape{200, 100} : SphereShape{900, 450}}) {
    const TriangleMesh mesh = make_sphere(shape);
    const TriangleBoxes tree = build_triangle_tree(mesh);
    std::vector<int> met(static_cast<std::size_t>(mesh.triangle_count()), 0);
    EXPECT_TRUE(boxes_hold(tree, 0, 0, met)) << shape.segments;
    EXPECT_TRUE(std::ranges::all_of(met, [](int times) { return times == 1; })) << shape.segments;
    EXPECT_EQ(tree.corners.size(), 9 * met.size());
    EXPECT_NEAR(tree.radius, 1.0, 1e-6);
    // Leaves hold four at the most, and nodes are in pairs.
    EXPECT_LT(tree.nodes.size(), 1 + met.size());
  }
}

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
  for (const auto& wrong :
       std::map<std::string, std::string>{{"", "mesh.obj"},
                                          {"v 0 0 0\n", "mesh.obj"},
                                          {"v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", "all without area"},
                                          {"v 0 0 0\nv 1 0 0\nv nan 1 0\nf 1 2 3\n", "all without area"},
                                          {"f 1 2 3\n", "mesh.obj"},
                                          {"v 0 0 0\nv 1 0 0\nf 1 2 900000\n", "mesh.obj"}}) {
    EXPECT_THAT(reason_of([&] { parse_mesh(wrong.first, MeshFormat::obj, "mesh.obj"); }),
                testing::AllOf(testing::HasSubstr("mesh.obj: "), testing::HasSubstr(wrong.second),
                               testing::HasSubstr("; give ")))
        << wrong.first;
  }
  for (const char* const text : {"", "{", "{}", R"({"asset":{"version":"2.0"}})", R"({"asset":{"version":"9.0"}})"}) {
    EXPECT_THAT(reason_of([&] { parse_mesh(text, MeshFormat::gltf, "mesh.gltf"); }), testing::HasSubstr("mesh.gltf: "))
        << text;
    EXPECT_THAT(reason_of([&] { parse_mesh(text, MeshFormat::glb, "mesh.glb"); }), testing::HasSubstr("mesh.glb: "))
        << text;
  }
}

class MeshFilesOnDisk : public test::FolderTest {
 protected:
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
};

TEST_F(MeshFilesOnDisk, AnObjHasTheColoursAndImagesOfItsMaterials) {
  write("a.mtl", "newmtl warm\nKd 0.5 0.25 0\nmap_Kd skin.png\nnewmtl cold\nKd 0 0 1\n");
  write("a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl warm\nf 1 2 3\nusemtl cold\nf 3 2 1\n");
  const TriangleMesh mesh = read_mesh(folder_ / "a.obj");
  ASSERT_EQ(mesh.parts.size(), 2U);
  EXPECT_THAT(mesh.parts[0].color, testing::ElementsAre(0.5F, 0.25F, 0.0F));
  EXPECT_EQ(mesh.parts[0].image.name, (folder_ / "skin.png").string());
  EXPECT_THAT(mesh.parts[1].color, testing::ElementsAre(0.0F, 0.0F, 1.0F));
  EXPECT_TRUE(mesh.parts[1].image.empty());
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
  EXPECT_EQ(position(mesh, 0).z, 5.0);
  EXPECT_THAT(mesh.parts.front().color, testing::ElementsAre(0.25F, 0.5F, 0.75F));
  std::filesystem::remove(folder_ / "b.bin");
  EXPECT_THAT(reason_of([&] { read_mesh(folder_ / "b.gltf"); }), testing::HasSubstr("b.gltf: "));
}

//! A triangle with a texture whose image's JSON is told.
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

TEST(MeshReader, RefusesAnImageInsideTheFileOfNoKnownKind) {
  EXPECT_THAT(reason_of([] {
                parse_mesh(gltf_with_image(R"({"bufferView":2,"mimeType":"image/../x"})"), MeshFormat::gltf, "a.gltf");
              }),
              testing::HasSubstr("neither PNG nor JPEG"));
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
  EXPECT_THAT(reason_of([&] { read_mesh(folder_ / "c.obj"); }), testing::HasSubstr("outside its folder"));
}

TEST_F(MeshFilesOnDisk, MaterialsThatAreNotThereAreAnErrorThatNamesThem) {
  write("d.obj", "mtllib colours.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl warm\nf 1 2 3\n");
  EXPECT_THAT(reason_of([&] { read_mesh(folder_ / "d.obj"); }),
              testing::AllOf(testing::HasSubstr("d.obj: names \"colours.mtl\""), testing::HasSubstr("put it there")));
  write("colours.mtl", "newmtl warm\nKd 0.5 0.25 0\n");
  EXPECT_THAT(read_mesh(folder_ / "d.obj").parts.front().color, testing::ElementsAre(0.5F, 0.25F, 0.0F));
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
  EXPECT_THAT(reason_of([&] { read_mesh(folder_ / "none.obj"); }), testing::HasSubstr("none.obj: "));
  write("d.stl", "solid\n");
  EXPECT_THAT(reason_of([&] { read_mesh(folder_ / "d.stl"); }),
              testing::AllOf(testing::HasSubstr("no kind of mesh"), testing::HasSubstr("glTF 2")));
}

}  // namespace
}  // namespace ergodome
