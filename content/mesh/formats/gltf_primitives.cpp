#include "content/mesh/formats/gltf_primitives.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>
#include <numeric>

#include "content/files/printable.h"
#include "content/files/whole_file.h"
#include "content/mesh/formats/gltf_materials.h"

namespace ergodome {

namespace {

using tinygltf::Accessor;
using Triangle = std::array<std::uint32_t, 3>;

//! Reads an attribute of a primitive for all its vertices; empty if the primitive does not have it.
//! Throws Error unless it has `count` entries of `min_count` to `maximum` components.
GltfNumbers attribute(const GltfFile& file, const std::map<std::string, int>& attributes, const std::string& name,
                      std::size_t count, int min_count, int maximum) {
  const auto found = attributes.find(name);
  if (found == attributes.end()) {
    return {};
  }
  GltfNumbers numbers = gltf_numbers(file, found->second);
  if (numbers.count() != count || numbers.components < min_count || numbers.components > maximum) {
    throw file.error(fmt::format(
        "has a primitive whose {} data has the wrong type or does not have one entry for each position", name));
  }
  return numbers;
}

glm::dvec3 vector_of(const float* numbers) { return {numbers[0], numbers[1], numbers[2]}; }

//! Returns the triangles of a list, strip or fan as vertex indices.
std::vector<Triangle> triangles_of(const GltfFile& file, int mode, const std::vector<std::uint32_t>& order) {
  std::vector<Triangle> triangles;
  const std::size_t count = order.size();
  switch (mode) {
    case TINYGLTF_MODE_TRIANGLES:
      for (std::size_t i = 0; i + 2 < count; i += 3) {
        triangles.push_back({order[i], order[i + 1], order[i + 2]});
      }
      break;
    case TINYGLTF_MODE_TRIANGLE_STRIP:
      for (std::size_t i = 0; i + 2 < count; ++i) {
        triangles.push_back({order[i], order[i + 1 + i % 2], order[i + 2 - i % 2]});
      }
      break;
    case TINYGLTF_MODE_TRIANGLE_FAN:
      for (std::size_t i = 1; i + 1 < count; ++i) {
        triangles.push_back({order[0], order[i], order[i + 1]});
      }
      break;
    default:
      throw file.error(fmt::format("has a primitive of the unknown mode {}", mode));
  }
  return triangles;
}

//! The vertices of a primitive before its transform is applied.
struct Shape {
  GltfNumbers positions;
  GltfNumbers normals;
  GltfNumbers textures;
  GltfNumbers colors;
  GltfNumbers joints;
  GltfNumbers weights;
};

void add_weighted(GltfNumbers& to, const GltfNumbers& targets, double weight) {
  for (std::size_t i = 0; i < std::min(to.values.size(), targets.values.size()); ++i) {
    to.values[i] += static_cast<float>(weight) * targets.values[i];
  }
}

//! Adds the morph targets to the vertices, each with its weight.
void morph(const GltfFile& file, const tinygltf::Primitive& primitive, const std::vector<double>& weights,
           Shape& shape) {
  const std::size_t count = shape.positions.count();
  for (std::size_t i = 0; i < std::min(primitive.targets.size(), weights.size()); ++i) {
    if (weights[i] != 0.0) {
      add_weighted(shape.positions, attribute(file, primitive.targets[i], "POSITION", count, 3, 3), weights[i]);
      add_weighted(shape.normals, attribute(file, primitive.targets[i], "NORMAL", count, 3, 3), weights[i]);
    }
  }
}

//! Returns the matrix that places a vertex: the weighted mean of its joints' matrices, or the
//! node's if there are no joints or all weights are 0. Weights need not add up to 1.
glm::dmat4 matrix_of(const GltfFile& file, const Shape& shape, const GltfPlacement& placement, std::size_t vertex) {
  if (placement.joints.empty() || shape.joints.values.empty() || shape.weights.values.empty()) {
    return placement.world;
  }
  glm::dmat4 sum(0.0);
  double total = 0.0;
  for (int i = 0; i < 4; ++i) {
    const auto weight = static_cast<double>(shape.weights[vertex][i]);
    if (weight > 0.0) {
      sum += weight * file.at(placement.joints, static_cast<int>(shape.joints[vertex][i]), "joint");
      total += weight;
    }
  }
  return total > 0.0 ? sum / total : placement.world;
}

class Placer {
 public:
  Placer(const GltfFile& file, const Shape& shape, const GltfPlacement& placement, const GltfTextureMapping& texture)
      : file_(file), shape_(shape), placement_(placement), texture_(texture) {}

  [[nodiscard]] SurfaceVertex vertex(std::size_t i) const {
    const glm::dmat4 matrix = matrix_of(file_, shape_, placement_, i);
    const glm::dvec3 position = glm::dvec3(matrix * glm::dvec4(vector_of(shape_.positions[i]), 1.0));
    if (!(std::isfinite(position.x) && std::isfinite(position.y) && std::isfinite(position.z))) {
      throw file_.error("has a vertex with a non-finite position");
    }
    SurfaceVertex vertex = {};
    put(position, vertex.position);
    if (!shape_.normals.values.empty()) {
      // The cofactor matrix is the inverse transpose up to a factor, and also exists for matrices
      // that flatten.
      const glm::dmat3 m(matrix);
      const glm::dmat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
      // For mirroring matrices, the cofactors have the opposite sign of the inverse transpose.
      const double side = glm::determinant(m) < 0.0 ? -1.0 : 1.0;
      const glm::dvec3 normal = side * (cofactors * vector_of(shape_.normals[i]));
      const double length = glm::length(normal);
      put(length > 0.0 ? normal / length : glm::dvec3(0.0), vertex.normal);
    }
    if (!shape_.textures.values.empty()) {
      const auto u = static_cast<double>(shape_.textures[i][0]);
      const auto v = static_cast<double>(shape_.textures[i][1]);
      // In glTF, v points down.
      vertex.texture[0] = static_cast<float>(texture_.u[0] * u + texture_.u[1] * v + texture_.u[2]);
      vertex.texture[1] = static_cast<float>(1.0 - (texture_.v[0] * u + texture_.v[1] * v + texture_.v[2]));
    }
    for (int c = 0; c < 3; ++c) {
      vertex.color[c] = shape_.colors.values.empty() ? 1.0F : std::clamp(shape_.colors[i][c], 0.0F, 1.0F);
    }
    return vertex;
  }

  //! Returns true if the node's transform reverses the orientation of triangles (mirroring). Always
  //! false with a skin.
  [[nodiscard]] bool mirrors() const {
    return placement_.joints.empty() && glm::determinant(glm::dmat3(placement_.world)) < 0.0;
  }

 private:
  static void put(const glm::dvec3& from, float (&to)[3]) {
    to[0] = static_cast<float>(from.x);
    to[1] = static_cast<float>(from.y);
    to[2] = static_cast<float>(from.z);
  }

  const GltfFile& file_;
  const Shape& shape_;
  const GltfPlacement& placement_;
  const GltfTextureMapping& texture_;
};

//! Sets the normals of a triangle's corners to the face normal, as glTF requires for meshes without
//! normals (3.7.2.1).
void make_flat(std::array<SurfaceVertex, 3>& corners) {
  const auto at = [&](std::size_t i) { return vector_of(corners.at(i).position); };
  const glm::dvec3 normal = glm::cross(at(1) - at(0), at(2) - at(0));
  const double length = glm::length(normal);
  for (SurfaceVertex& corner : corners) {
    for (int axis = 0; axis < 3; ++axis) {
      corner.normal[axis] = length > 0.0 ? static_cast<float>(normal[axis] / length) : 0.0F;
    }
  }
}

Shape shape_of(const GltfFile& file, const tinygltf::Primitive& primitive, const GltfTextureMapping& texture,
               const GltfPlacement& placement) {
  const auto found = primitive.attributes.find("POSITION");
  Shape shape;
  if (found == primitive.attributes.end()) {
    return shape;
  }
  const Accessor& positions = file.at(file.model.accessors, found->second, "accessor");
  if (positions.bufferView < 0 && !positions.sparse.isSparse) {
    throw primitive.extensions.empty()
        ? file.error("has positions without a buffer")
        : Error(file.location,
                fmt::format("has triangles in the unsupported glTF extension {}",
                            printable(primitive.extensions.begin()->first.substr(0, 100))),
                "export it without that extension");
  }
  shape.positions = gltf_numbers(file, found->second);
  if (shape.positions.components != 3) {
    throw file.error("has positions that do not have three components");
  }
  const std::size_t count = shape.positions.count();
  const auto read = [&](const std::string& name, int min_count, int maximum) {
    return attribute(file, primitive.attributes, name, count, min_count, maximum);
  };
  shape.normals = read("NORMAL", 3, 3);
  shape.textures = read(fmt::format("TEXCOORD_{}", texture.set), 2, 2);
  shape.colors = read("COLOR_0", 3, 4);
  if (!placement.joints.empty()) {
    shape.joints = read("JOINTS_0", 4, 4);
    shape.weights = read("WEIGHTS_0", 4, 4);
  }
  return shape;
}

void remark_on(const GltfFile& file, const tinygltf::Primitive& primitive, const Shape& shape,
               const GltfTextureMapping& texture, const GltfPlacement& placement, MeshBuilder& builder) {
  if (texture.textured && shape.textures.values.empty()) {
    builder.remark(fmt::format(
        "has textured triangles without texture coordinates (TEXCOORD_{}); they show a single texel of their texture",
        texture.set));
  }
  const bool cut =
      primitive.material >= 0 && gltf_alpha_counts(file.at(file.model.materials, primitive.material, "material"));
  for (std::size_t i = 0; cut && shape.colors.components == 4 && i < shape.colors.count(); ++i) {
    if (shape.colors[i][3] < 1.0F) {
      builder.remark("has transparent vertex colors, which are drawn opaque");
      break;
    }
  }
  if (!placement.joints.empty() && primitive.attributes.contains("JOINTS_1")) {
    builder.remark("has vertices with more than four joints; only the first four are used");
  }
}

}  // namespace

void add_gltf_primitive(const GltfFile& file, const tinygltf::Primitive& primitive, const GltfPlacement& placement,
                        MeshBuilder& builder) {
  const int mode = primitive.mode < 0 ? TINYGLTF_MODE_TRIANGLES : primitive.mode;
  if (mode < TINYGLTF_MODE_TRIANGLES) {
    builder.remark("has points or lines, which are not drawn");
    return;
  }
  const GltfTextureMapping texture = gltf_texture_mapping(file, primitive.material);
  Shape shape = shape_of(file, primitive, texture, placement);
  if (placement.weights != nullptr) {
    morph(file, primitive, *placement.weights, shape);
  }
  std::vector<std::uint32_t> order;
  if (primitive.indices >= 0) {
    order = gltf_whole_numbers(file, primitive.indices);
  } else {
    order.resize(shape.positions.count());
    std::iota(order.begin(), order.end(), 0U);
  }
  for (const std::uint32_t index : order) {
    if (index >= shape.positions.count()) {
      throw file.error("has a triangle that refers to a nonexistent vertex");
    }
  }
  const std::vector<Triangle> triangles = triangles_of(file, mode, order);
  const bool flat = shape.normals.values.empty();
  builder.reserve(triangles.size(), flat ? 3 * triangles.size() : shape.positions.count());
  remark_on(file, primitive, shape, texture, placement, builder);
  const Placer placer(file, shape, placement, texture);
  std::vector<std::uint32_t> placed;
  for (std::size_t i = 0; i < shape.positions.count() && !flat && !triangles.empty(); ++i) {
    placed.push_back(builder.add_vertex(placer.vertex(i)));
  }
  const bool mirrors = placer.mirrors();
  for (auto [a, b, c] : triangles) {
    throw_if_reading_stopped(file.location);
    if (mirrors) {
      std::swap(b, c);
    }
    if (!flat) {
      builder.add_triangle(primitive.material, placed[a], placed[b], placed[c]);
      continue;
    }
    std::array<SurfaceVertex, 3> corners = {placer.vertex(a), placer.vertex(b), placer.vertex(c)};
    make_flat(corners);
    const std::uint32_t first = builder.add_vertex(corners[0]);
    const std::uint32_t second = builder.add_vertex(corners[1]);
    builder.add_triangle(primitive.material, first, second, builder.add_vertex(corners[2]));
  }
}

}  // namespace ergodome
