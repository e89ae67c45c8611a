#include "content/mesh/formats/gltf_reader.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "content/mesh/formats/mesh_reader.h"
#include "tests/support/errors.h"

// Tests with glTF files as other programs write them. Expected values follow from the glTF 2.0
// specification.
namespace ergodome {
namespace {

namespace fs = std::filesystem;
using test::error_of;
using testing::ElementsAre;
using testing::ElementsAreArray;
using testing::FloatNear;
using testing::HasSubstr;
using testing::IsEmpty;

const fs::path meshes = fs::path(ERGODOME_TEST_DATA_DIR) / "foreign" / "meshes";

std::string base64(const std::string& bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      word = word << 8U | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += i + k > bytes.size() ? '=' : digits[word >> (18U - 6U * k) & 63U];
    }
  }
  return text;
}

//! Builds the text of a glTF file.
class GltfText {
 public:
  //! Adds an accessor that contains the given numbers; returns its index.
  template <class Number>
  int add(const std::vector<Number>& numbers, int component_type, const char* type, int components,
          const std::string& more = "") {
    const std::string bytes(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number));
    views_ += fmt::format("{}{{\"buffer\":0,\"byteOffset\":{},\"byteLength\":{}}}", accessors_ > 0 ? "," : "",
                          buffer_.size(), bytes.size());
    texts_ +=
        fmt::format("{}{{\"bufferView\":{},\"componentType\":{},\"count\":{},\"type\":\"{}\"{}}}",
                    accessors_ > 0 ? "," : "", accessors_, component_type, numbers.size() / components, type, more);
    buffer_ += bytes;
    buffer_.resize((buffer_.size() + 3) / 4 * 4);
    return accessors_++;
  }
  int add_floats(const std::vector<float>& numbers, const char* type, int components, const std::string& more = "") {
    return add(numbers, 5126, type, components, more);
  }

  //! Returns the text of the file. `primitive`: JSON of its only primitive; `nodes`: JSON of its
  //! nodes, "[{...}]"; `more`: further members of the file, such as ",\"materials\":[...]".
  [[nodiscard]] std::string text(const std::string& primitive, const std::string& nodes = R"([{"mesh":0}])",
                                 const std::string& more = "") const {
    return fmt::format(
        R"({{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":{},"meshes":[{{"primitives":[{}]}}],
            "buffers":[{{"uri":"data:application/octet-stream;base64,{}","byteLength":{}}}],
            "bufferViews":[{}],"accessors":[{}]{}}})",
        nodes, primitive, base64(buffer_), buffer_.size(), views_, texts_, more);
  }

 private:
  std::string buffer_;
  std::string views_;
  std::string texts_;
  int accessors_ = 0;
};

TriangleMesh gltf_mesh(const std::string& text) { return parse_mesh(text, MeshFormat::gltf, "a.gltf"); }

const std::vector<float> corners = {0, 0, 0, 1, 0, 0, 0, 1, 0};

//! Returns the text of a file with a triangle in the plane z = 0.
std::string one_triangle(const std::string& nodes = R"([{"mesh":0}])", const std::string& more = "") {
  GltfText file;
  file.add_floats(corners, "VEC3", 3);
  return file.text(R"({"attributes":{"POSITION":0}})", nodes, more);
}

TEST(GltfReader, NormalizedIntegersAreFractions) {
  const TriangleMesh mesh = read_mesh(meshes / "integer_uv.gltf");
  for (const SurfaceVertex& vertex : mesh.vertices) {
    for (const float at : vertex.texture) {
      EXPECT_TRUE(at == 0.0F || at == 1.0F) << at;
    }
  }
}

TEST(GltfReader, QuantizedPositionsAndNormalsAreWhatTheyStandFor) {
  GltfText file;
  file.add(std::vector<std::int16_t>{0, 0, 0, 32767, 0, 0, 0, -32767, 0}, 5122, "VEC3", 3, R"(,"normalized":true)");
  file.add(std::vector<std::int8_t>{0, 0, -127, 0, 0, -127, 0, 0, -127}, 5120, "VEC3", 3, R"(,"normalized":true)");
  file.add(std::vector<std::uint8_t>{0, 1, 2}, 5121, "SCALAR", 1);
  const TriangleMesh mesh =
      gltf_mesh(file.text(R"({"attributes":{"POSITION":0,"NORMAL":1},"indices":2})", R"([{"mesh":0,"scale":[2,2,2]}])",
                          R"(,"extensionsRequired":["KHR_mesh_quantization"])"));
  EXPECT_THAT(mesh.vertices.at(1).position, ElementsAre(2.0F, 0.0F, 0.0F));
  EXPECT_THAT(mesh.vertices.at(2).position, ElementsAre(0.0F, -2.0F, 0.0F));
  EXPECT_THAT(mesh.vertices.at(0).normal, ElementsAre(0.0F, 0.0F, -1.0F));
}

TEST(GltfReader, RefusesExtensionsThatAreRequiredAndNotRead) {
  EXPECT_THAT(error_of([] { read_mesh(meshes / "requires_instancing.gltf"); }), HasSubstr("EXT_mesh_gpu_instancing"));
  EXPECT_THAT(error_of([] { read_mesh(meshes / "requires_unknown.gltf"); }),
              HasSubstr("requires the unsupported glTF extension"));
  for (const char* const name : {"KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_texture_basisu"}) {
    const std::string more = fmt::format(",\"extensionsRequired\":[\"{}\"]", name);
    EXPECT_THAT(error_of([&] { gltf_mesh(one_triangle(R"([{"mesh":0}])", more)); }), HasSubstr(name));
  }
  EXPECT_EQ(gltf_mesh(one_triangle(R"([{"mesh":0}])", R"(,"extensionsUsed":["VENDOR_own"])")).triangle_count(), 1);
}

TEST(GltfReader, TakesTheTextureCoordinatesThatTheMaterialNames) {
  const TriangleMesh mesh = read_mesh(meshes / "texcoord_1.gltf");
  EXPECT_TRUE(std::ranges::any_of(mesh.vertices, [](const SurfaceVertex& v) { return v.texture[0] > 0.9F; }));
  EXPECT_THAT(mesh.remarks, IsEmpty());
}

TEST(GltfReader, SamplersSayHowAPictureGoesOn) {
  const TriangleMesh mesh = read_mesh(meshes / "clamp_to_edge.gltf");
  EXPECT_EQ(mesh.parts.at(0).wrap_u, TextureWrap::clamp);
  EXPECT_EQ(mesh.parts.at(0).wrap_v, TextureWrap::clamp);
}

TEST(GltfReader, ColoursOfVerticesAreLinear) {
  const TriangleMesh mesh = read_mesh(meshes / "vertex_colors.gltf");
  EXPECT_THAT(mesh.vertices.at(0).color,
              ElementsAreArray({FloatNear(0.7F, 1e-6F), FloatNear(0.0F, 1e-6F), FloatNear(0.0F, 1e-6F)}));
}

TEST(GltfReader, TransformsOfTexturesTurnThemCounterclockwise) {
  GltfText file;
  file.add_floats(corners, "VEC3", 3);
  file.add_floats({0, 0, 1, 0, 0, 1}, "VEC2", 2);
  const TriangleMesh mesh = gltf_mesh(
      file.text(R"({"attributes":{"POSITION":0,"TEXCOORD_3":1},"material":0})", R"([{"mesh":0}])",
                fmt::format(R"(,"materials":[{{"pbrMetallicRoughness":{{"baseColorTexture":{{"index":0,"extensions":{{
          "KHR_texture_transform":{{"offset":[0.5,0.25],"rotation":{},"scale":[2,3],"texCoord":3}}}}}}}}}}],
          "textures":[{{"source":0}}],"images":[{{"uri":"data:image/png;base64,aGVsbG8="}}],
          "extensionsUsed":["KHR_texture_transform"],"extensionsRequired":["KHR_texture_transform"])",
                            M_PI / 2.0)));
  // The texture transform is u' = 3 v sin(rotation) + 0.5, v' = -2 u sin(rotation) + 0.25. glTF's v
  // points downwards, Ergodome's v upwards.
  const auto near = [](float u, float v) { return ElementsAre(FloatNear(u, 1e-6F), FloatNear(1.0F - v, 1e-6F)); };
  EXPECT_THAT(mesh.vertices.at(0).texture, near(0.5F, 0.25F));
  EXPECT_THAT(mesh.vertices.at(1).texture, near(0.5F, -1.75F));
  EXPECT_THAT(mesh.vertices.at(2).texture, near(3.5F, 0.25F));
}

TEST(GltfReader, FacesWithoutNormalsAreFlat) {
  GltfText file;
  file.add_floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, "VEC3", 3);
  file.add(std::vector<std::uint16_t>{0, 1, 2, 0, 3, 1}, 5123, "SCALAR", 1);
  const TriangleMesh mesh = gltf_mesh(file.text(R"({"attributes":{"POSITION":0},"indices":1})"));
  EXPECT_THAT(mesh.vertices.at(mesh.indices.at(0)).normal, ElementsAre(0.0F, 0.0F, 1.0F));
  EXPECT_THAT(mesh.vertices.at(mesh.indices.at(3)).normal, ElementsAre(0.0F, 1.0F, 0.0F));
}

TEST(GltfReader, MirroredNodesKeepTheirOutside) {
  const TriangleMesh mesh = gltf_mesh(one_triangle(R"([{"mesh":0,"scale":[-1,1,1]}])"));
  EXPECT_THAT(mesh.vertices.at(mesh.indices.at(0)).normal, ElementsAre(0.0F, 0.0F, 1.0F));
}

TEST(GltfReader, StripsAndFansAreTriangles) {
  GltfText file;
  file.add_floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, "VEC3", 3);
  for (const int mode : {5, 6}) {
    const TriangleMesh mesh = gltf_mesh(file.text(fmt::format(R"({{"attributes":{{"POSITION":0}},"mode":{}}})", mode)));
    EXPECT_EQ(mesh.triangle_count(), 2) << mode;
    EXPECT_THAT(mesh.vertices.at(mesh.indices.at(0)).normal, ElementsAre(0.0F, 0.0F, 1.0F)) << mode;
  }
  const TriangleMesh strip = gltf_mesh(file.text(R"({"attributes":{"POSITION":0},"mode":5})"));
  EXPECT_THAT(strip.vertices.at(strip.indices.at(3)).normal, ElementsAre(0.0F, 0.0F, 1.0F))
      << "each second one is turned";
  EXPECT_THAT(error_of([&] { gltf_mesh(file.text(R"({"attributes":{"POSITION":0},"mode":1})")); }),
              HasSubstr("has no triangles"));
}

TEST(GltfReader, SparseAccessorsReplaceEntries) {
  GltfText file;
  file.add_floats(corners, "VEC3", 3, R"(,"sparse":{"count":1,"indices":{"bufferView":1,"componentType":5121},
                                          "values":{"bufferView":2}})");
  file.add(std::vector<std::uint8_t>{2}, 5121, "SCALAR", 1);
  file.add_floats({0, 5, 0}, "VEC3", 3);
  EXPECT_THAT(gltf_mesh(file.text(R"({"attributes":{"POSITION":0}})")).vertices.at(2).position,
              ElementsAre(0.0F, 5.0F, 0.0F));
}

TEST(GltfReader, SkinsStandInThePoseOfTheirJoints) {
  GltfText file;
  file.add_floats(corners, "VEC3", 3);
  file.add(std::vector<std::uint8_t>{0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}, 5121, "VEC4", 4);
  file.add_floats({1, 0, 0, 0, 1, 0, 0, 0, 0.5, 0.5, 0, 0}, "VEC4", 4);
  // The matrices are the inverse bind matrices of two joints; the second joint is at (1, 0, 0).
  file.add_floats({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1, 0, 0, 1},
                  "MAT4", 16);
  const TriangleMesh mesh = gltf_mesh(
      file.text(R"({"attributes":{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2}})",
                R"([{"children":[1,2,3]},{"mesh":0,"skin":0,"translation":[9,9,9]},{},{"translation":[1,0,4]}])",
                R"(,"skins":[{"joints":[2,3],"inverseBindMatrices":3}])"));
  EXPECT_THAT(mesh.vertices.at(0).position, ElementsAre(0.0F, 0.0F, 0.0F)) << "the node itself moves nothing";
  EXPECT_THAT(mesh.vertices.at(1).position, ElementsAre(1.0F, 0.0F, 4.0F));
  EXPECT_THAT(mesh.vertices.at(2).position, ElementsAre(0.0F, 1.0F, 2.0F));
}

TEST(GltfReader, MorphTargetsWeighAsTheFileBegins) {
  GltfText file;
  file.add_floats(corners, "VEC3", 3);
  file.add_floats({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", 3);
  const std::string primitive = R"({"attributes":{"POSITION":0},"targets":[{"POSITION":1}]})";
  const std::string text = file.text(primitive);
  const auto lifted = [](const std::string& of) { return gltf_mesh(of).vertices.at(0).position[2]; };
  EXPECT_EQ(lifted(text), 0.0F);
  EXPECT_EQ(lifted(file.text(primitive, R"([{"mesh":0,"weights":[0.5]}])")), 0.5F);
  std::string of_mesh = text;
  of_mesh.replace(of_mesh.find(R"("primitives")"), 12, R"("weights":[0.25],"primitives")");
  EXPECT_EQ(lifted(of_mesh), 0.25F);
}

TEST(GltfReader, WhatOnlyGlowsIsDrawnAsItsGlow) {
  GltfText file;
  file.add_floats(corners, "VEC3", 3);
  const auto with = [&](const char* material) {
    return gltf_mesh(file.text(R"({"attributes":{"POSITION":0},"material":0})", R"([{"mesh":0}])",
                               fmt::format(",\"materials\":[{}]", material)));
  };
  EXPECT_THAT(
      with(R"({"emissiveFactor":[1,0.5,0],"pbrMetallicRoughness":{"baseColorFactor":[0,0,0,1]}})").parts.at(0).color,
      ElementsAre(1.0F, 0.5F, 0.0F));
  EXPECT_THAT(with(R"({"emissiveFactor":[1,0.5,0]})").remarks, ElementsAre(HasSubstr("emissive")));
  EXPECT_THAT(with(R"({"extensions":{"KHR_materials_transmission":{"transmissionFactor":1}}})").remarks,
              ElementsAre(HasSubstr("transmissive materials")));
}

TEST(GltfReader, ANodeHasOneParent) {
  EXPECT_THAT(error_of([] { read_mesh(fs::path(ERGODOME_TEST_DATA_DIR) / "foreign" / "damaged" / "fan.gltf"); }),
              HasSubstr("more than once in its tree"));
  for (const char* const nodes : {R"([{"children":[1],"mesh":0},{"children":[0]}])", R"([{"mesh":0,"children":[0]}])",
                                  R"([{"children":[1,1]},{"mesh":0}])"}) {
    EXPECT_THAT(error_of([&] { gltf_mesh(one_triangle(nodes)); }), HasSubstr("more than once in its tree")) << nodes;
  }
}

TEST(GltfReader, LongChainsOfNodesArePlacedLikeShortOnes) {
  std::string nodes = "[";
  constexpr int length = 10'000;
  for (int i = 0; i + 1 < length; ++i) {
    nodes += fmt::format(R"({{"translation":[0,0,1],"children":[{}]}},)", i + 1);
  }
  EXPECT_EQ(gltf_mesh(one_triangle(nodes + R"({"mesh":0}])")).vertices.at(0).position[2], length - 1.0F);
}

TEST(GltfReader, RefusesJsonThatIsTooDeepOrTooMuch) {
  const auto nested = [](int depth) {
    return one_triangle(R"([{"mesh":0}])", ",\"extras\":" + std::string(static_cast<std::size_t>(depth), '[') +
                                               std::string(static_cast<std::size_t>(depth), ']'));
  };
  EXPECT_EQ(gltf_mesh(nested(50)).triangle_count(), 1);
  EXPECT_THAT(error_of([&] { gltf_mesh(nested(174'000)); }), HasSubstr("deeper than 64 levels"));
  std::string many = "[{\"mesh\":0}";
  for (int i = 0; i < 300'000; ++i) {
    many += ",{}";
  }
  EXPECT_THAT(error_of([&] { gltf_mesh(one_triangle(many + "]")); }), HasSubstr("more than 200000 objects"));
}

TEST(GltfReader, RefusesWhatIsNotInItsBuffers) {
  const std::string text = one_triangle();
  const auto with = [&](const std::string& part, const std::string& other) {
    std::string changed = text;
    changed.replace(changed.find(part), part.size(), other);
    return error_of([&] { gltf_mesh(changed); });
  };
  EXPECT_THAT(with("\"count\":3", "\"count\":4"), HasSubstr("beyond its buffer"));
  EXPECT_THAT(with("\"count\":3", "\"count\":3000000000"), HasSubstr("beyond its buffer"));
  EXPECT_THAT(with("\"bufferView\":0", "\"bufferView\":7"), HasSubstr("buffer view 7, which does not exist"));
  EXPECT_THAT(with("\"bufferView\":0,", ""), HasSubstr("without a buffer"));
  EXPECT_THAT(with("\"byteLength\":36}]", "\"byteLength\":6000000000}]"), HasSubstr("a.gltf"));
  EXPECT_THAT(with("\"mesh\":0", "\"mesh\":9"), HasSubstr("mesh 9, which does not exist"));
  EXPECT_THAT(with("\"version\":\"2.0\"", "\"version\":\"1.0\""), HasSubstr("is glTF 1.0"));
}

TEST(GltfReader, NormalsOfMirroredNodesPointOutwards) {
  const TriangleMesh mesh = read_mesh(meshes / "negative_scale.gltf");
  for (const std::uint32_t index : mesh.indices) {
    EXPECT_THAT(mesh.vertices.at(index).normal, ElementsAre(0.0F, 0.0F, 1.0F));
  }
  const auto& a = mesh.vertices.at(mesh.indices.at(0)).position;
  const auto& b = mesh.vertices.at(mesh.indices.at(1)).position;
  const auto& c = mesh.vertices.at(mesh.indices.at(2)).position;
  EXPECT_GT((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]), 0.0F) << "counterclockwise from outside";
}

TEST(GltfReader, HiddenNodesAreNotDrawnNorAreTheirChildren) {
  const TriangleMesh mesh = read_mesh(meshes / "hidden_node.gltf");
  EXPECT_EQ(mesh.triangle_count(), 1);
  EXPECT_EQ(mesh.vertices.at(mesh.indices.at(0)).position[0], 0.0F);
  const std::string visible = R"([{"mesh":0,"extensions":{"KHR_node_visibility":{"visible":true}}}])";
  EXPECT_EQ(gltf_mesh(one_triangle(visible)).triangle_count(), 1);
}

TEST(GltfReader, RemarksOnPointsAndLines) {
  const TriangleMesh mesh = read_mesh(meshes / "lines_beside_triangles.gltf");
  EXPECT_EQ(mesh.triangle_count(), 1);
  EXPECT_THAT(mesh.remarks, ElementsAre(HasSubstr("points or lines")));
}

TEST(GltfReader, NamesFormatsOfTexturesThatAreNotRead) {
  EXPECT_THAT(error_of([] { read_mesh(meshes / "basisu_only.gltf"); }), HasSubstr("KHR_texture_basisu"));
  EXPECT_THAT(read_mesh(meshes / "webp_only.gltf").parts.at(0).image.name, testing::EndsWith("quad.webp"));
  EXPECT_THAT(read_mesh(meshes / "webp_with_png.gltf").parts.at(0).image.name, testing::EndsWith("quad.png"));
}

//! Returns the text of a file with a textured triangle. `image` is the JSON of the image for its
//! texture.
std::string with_image(const std::string& image) {
  GltfText file;
  file.add_floats(corners, "VEC3", 3);
  file.add_floats({0, 0, 1, 0, 0, 1}, "VEC2", 2);
  return file.text(R"({"attributes":{"POSITION":0,"TEXCOORD_0":1},"material":0})", R"([{"mesh":0}])",
                   fmt::format(R"(,"materials":[{{"pbrMetallicRoughness":{{"baseColorTexture":{{"index":0}}}}}}],
                                  "textures":[{{"source":0}}],"images":[{}])",
                               image));
}

TEST(GltfReader, TellsImagesInsideTheFileByTheirBytes) {
  const std::string png = base64("\x89PNG and more");
  for (const char* const type : {"image/png", "image/jpeg", "application/octet-stream", ""}) {
    const TriangleMesh mesh = gltf_mesh(with_image(fmt::format(R"({{"uri":"data:{};base64,{}"}})", type, png)));
    EXPECT_THAT(mesh.parts.at(0).image.name, testing::EndsWith(".png")) << type;
  }
  for (const char* const type : {"image/png", "image/webp"}) {
    const auto of = [&](const std::string& bytes) {
      return with_image(fmt::format(R"({{"uri":"data:{};base64,{}"}})", type, base64(bytes)));
    };
    EXPECT_THAT(gltf_mesh(of("RIFF....WEBPVP8 ")).parts.at(0).image.name, testing::EndsWith(".webp")) << type;
    EXPECT_THAT(error_of([&] { gltf_mesh(of("\xABKTX 20")); }), HasSubstr("image 0 in an unsupported format"));
  }
}

TEST(GltfReader, AlphaOfPicturesCountsByTheModeOfTheMaterial) {
  const std::string image = R"({"uri":"data:image/png;base64,aGVsbG8="})";
  std::string text = with_image(image);
  EXPECT_FALSE(gltf_mesh(text).parts.at(0).image_alpha_counts);
  text.insert(text.find(R"("pbrMetallicRoughness")"), R"("alphaMode":"MASK",)");
  EXPECT_TRUE(gltf_mesh(text).parts.at(0).image_alpha_counts);
}

TEST(GltfReader, RemarksOnTransparencyThatTheMaterialAsksFor) {
  const auto remarks = [](const char* material, float alpha) {
    GltfText file;
    file.add_floats(corners, "VEC3", 3);
    file.add_floats({1, 1, 1, 1, 1, 1, 1, alpha, 1, 1, 1, 1}, "VEC4", 4);
    return gltf_mesh(file.text(R"({"attributes":{"POSITION":0,"COLOR_0":1},"material":0})", R"([{"mesh":0}])",
                               fmt::format(",\"materials\":[{}]", material)))
        .remarks;
  };
  EXPECT_THAT(remarks(R"({"alphaMode":"BLEND"})", 0.5F), ElementsAre(HasSubstr("transparent vertex colors")));
  EXPECT_THAT(remarks(R"({"alphaMode":"BLEND"})", 1.0F), IsEmpty());
  EXPECT_THAT(remarks("{}", 0.5F), IsEmpty());
  const char* const below = R"({"alphaMode":"MASK","pbrMetallicRoughness":{"baseColorFactor":[1,1,1,0.4]}})";
  const char* const above = R"({"alphaMode":"MASK","pbrMetallicRoughness":{"baseColorFactor":[1,1,1,0.6]}})";
  EXPECT_THAT(remarks(below, 1.0F), ElementsAre(HasSubstr("drawn opaque")));
  EXPECT_THAT(remarks(above, 1.0F), IsEmpty()) << "the cutoff is 0.5";
}

TEST(GltfReader, TheStrengthOfAGlowMultipliesIt) {
  EXPECT_THAT(read_mesh(meshes / "emissive_strength.gltf").parts.at(0).color, ElementsAre(4.0F, 2.0F, 1.0F));
}

TEST(GltfReader, DiffuseTexturesAreTransformedLikeOthers) {
  const TriangleMesh mesh = read_mesh(meshes / "spec_gloss_transform.gltf");
  EXPECT_THAT(mesh.parts.at(0).color, ElementsAre(1.0F, 0.5F, 0.25F));
  EXPECT_THAT(mesh.vertices.at(1).texture, ElementsAre(2.5F, 0.75F));
}

TEST(GltfReader, AccessorsWithoutABufferAreZero) {
  EXPECT_EQ(read_mesh(meshes / "zero_morph.gltf").vertices.at(1).position[0], 1.0F);
  GltfText file;
  file.add(std::vector<std::uint8_t>{1, 2}, 5121, "SCALAR", 1);
  file.add_floats({1, 0, 0, 0, 1, 0}, "VEC3", 3);
  std::string text = file.text(R"({"attributes":{"POSITION":0}})");
  const std::string accessor = R"({"bufferView":0,"componentType":5121,"count":2,"type":"SCALAR"})";
  text.replace(text.find(accessor), accessor.size(), R"({"componentType":5126,"count":3,"type":"VEC3","sparse":
      {"count":2,"indices":{"bufferView":0,"componentType":5121},"values":{"bufferView":1}}})");
  const TriangleMesh mesh = gltf_mesh(text);
  EXPECT_THAT(mesh.vertices.at(0).position, ElementsAre(0.0F, 0.0F, 0.0F));
  EXPECT_THAT(mesh.vertices.at(2).position, ElementsAre(0.0F, 1.0F, 0.0F));
}

TEST(GltfReader, EntriesMayLieApartInTheirBuffer) {
  // Positions and normals alternate in the buffer, as in the glTF sample BoxInterleaved.
  GltfText file;
  file.add_floats({0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 1}, "VEC3", 3);
  std::string text = file.text(R"({"attributes":{"POSITION":0,"NORMAL":1}})");
  const std::string view = R"("byteLength":72}])";
  text.replace(text.rfind(view), view.size(), R"("byteLength":72,"byteStride":24}])");
  const std::string accessor = R"({"bufferView":0,"componentType":5126,"count":6,"type":"VEC3"})";
  text.replace(text.find(accessor), accessor.size(),
               R"({"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},
                  {"bufferView":0,"byteOffset":12,"componentType":5126,"count":3,"type":"VEC3"})");
  const TriangleMesh mesh = gltf_mesh(text);
  EXPECT_THAT(mesh.vertices.at(1).position, ElementsAre(1.0F, 0.0F, 0.0F));
  EXPECT_THAT(mesh.vertices.at(2).normal, ElementsAre(0.0F, 0.0F, 1.0F));
}

TEST(GltfReader, NamesTheCompressionThatKeepsTrianglesFromIt) {
  EXPECT_THAT(error_of([] { read_mesh(meshes / "draco_without_fallback.gltf"); }),
              HasSubstr("KHR_draco_mesh_compression"));
  EXPECT_THAT(error_of([] { read_mesh(meshes / "meshopt_fallback.glb"); }), HasSubstr("buffer 1 without data"));
}

TEST(GltfReader, RequiredExtensionsAreNamedBeforeWhatTheyLeadTo) {
  std::string text = one_triangle(R"([{"mesh":0}])", R"(,"extensionsRequired":["EXT_meshopt_compression"])");
  text.replace(text.find(R"("uri":"data:)"), 12, R"("other":"data:)");
  EXPECT_THAT(error_of([&] { gltf_mesh(text); }),
              HasSubstr("requires the unsupported glTF extension EXT_meshopt_compression"));
}

TEST(GltfReader, ReadsDataOfAnyMediaType) { EXPECT_EQ(read_mesh(meshes / "untyped_data.gltf").triangle_count(), 1); }

TEST(GltfReader, WhatNoSceneShowsIsNotDrawn) {
  const char* const nodes = R"([{"matrix":[2,0,0,0, 0,3,0,0, 0,0,1,0, 7,8,9,1],"mesh":0},{"mesh":0}])";
  const TriangleMesh mesh = gltf_mesh(one_triangle(nodes));
  EXPECT_EQ(mesh.triangle_count(), 1);
  EXPECT_THAT(mesh.vertices.at(1).position, ElementsAre(9.0F, 8.0F, 9.0F));
  std::string text = one_triangle(nodes);
  const std::string scenes = R"("scene":0,"scenes":[{"nodes":[0]}],)";
  EXPECT_EQ(gltf_mesh(text.replace(text.find(scenes), scenes.size(), "")).triangle_count(), 2) << "without a scene all";
  text = one_triangle(nodes);
  text.replace(text.find(scenes), scenes.size(), R"("scene":1,"scenes":[{"nodes":[0]},{"nodes":[1]}],)");
  EXPECT_THAT(gltf_mesh(text).vertices.at(1).position, ElementsAre(1.0F, 0.0F, 0.0F)) << "the default scene";
}

}  // namespace
}  // namespace ergodome
