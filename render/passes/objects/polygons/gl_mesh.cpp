#include "render/passes/objects/polygons/gl_mesh.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "kernels/core/error.h"
#include "render/opengl/gl_program.h"
#include "render/passes/objects/object_meshes.h"

namespace ergodome {

namespace {

//! Returns whether a part's texture coordinates are all in [0, 1]. The image is then not repeated,
//! and its opposite edges must not be blended.
bool shows_image_once(const TriangleMesh& mesh, const MeshPart& part) {
  const auto first = mesh.indices.begin() + static_cast<std::ptrdiff_t>(part.first_index);
  return std::all_of(first, first + static_cast<std::ptrdiff_t>(part.index_count), [&](std::uint32_t index) {
    const auto& at = mesh.vertices[index].texture;
    return std::ranges::all_of(at, [](float position) { return position >= 0.0F && position <= 1.0F; });
  });
}

GLint wrap_of(TextureWrap wrap) {
  return wrap == TextureWrap::clamp ? GL_CLAMP_TO_EDGE : wrap == TextureWrap::mirror ? GL_MIRRORED_REPEAT : GL_REPEAT;
}

unsigned texture_of(const TriangleMesh& mesh, const MeshPart& part) {
  const OverlayImage image = read_mesh_image(part.image);
  GLuint texture = 0;
  glCreateTextures(GL_TEXTURE_2D, 1, &texture);
  glTextureStorage2D(texture, image.level_count, GL_RGBA16, image.width, image.height);
  for (int level = 0; level < image.level_count; ++level) {
    const int width = std::max(image.width >> level, 1);
    const int height = std::max(image.height >> level, 1);
    glTextureSubImage2D(texture, level, 0, 0, width, height, GL_RGBA, GL_UNSIGNED_SHORT,
                        image.texels.data() + 4 * image.level_offset[static_cast<std::size_t>(level)]);
  }
  glTextureParameteri(texture, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTextureParameteri(texture, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  const bool once = shows_image_once(mesh, part);
  glTextureParameteri(texture, GL_TEXTURE_WRAP_S, once ? GL_CLAMP_TO_EDGE : wrap_of(part.wrap_u));
  glTextureParameteri(texture, GL_TEXTURE_WRAP_T, once ? GL_CLAMP_TO_EDGE : wrap_of(part.wrap_v));
  return texture;
}

void describe(unsigned vertex_array, unsigned at, int count, std::size_t offset) {
  glEnableVertexArrayAttrib(vertex_array, at);
  glVertexArrayAttribFormat(vertex_array, at, count, GL_FLOAT, GL_FALSE, static_cast<GLuint>(offset));
  glVertexArrayAttribBinding(vertex_array, at, 0);
}

//! Returns the maximum number of patches per draw call if OpenGL renders on the CPU. Mesa 22's
//! llvmpipe counts the vertices of all tessellated patches of a call in 16 bits, and mixes up
//! patches beyond that. A patch of level n has about 3/4 n² + 3/2 n + 3 vertices.
std::uint32_t software_patches(double max_level) {
  const double level = std::ceil(max_level);
  return static_cast<std::uint32_t>(65535.0 / (0.75 * level * level + 1.5 * level + 3.0));
}

}  // namespace

GlMesh::GlMesh(const TriangleMesh& mesh) : in_software_(draws_in_software()) {
  for (const MeshPart& part : mesh.parts) {
    parts_.push_back({part.first_index, part.index_count, part.color, part.image.empty() ? 0 : texture_of(mesh, part)});
  }
  while (glGetError() != GL_NO_ERROR) {
  }
  glCreateBuffers(1, &vertices_);
  glNamedBufferStorage(vertices_, static_cast<GLsizeiptr>(mesh.vertices.size() * sizeof(SurfaceVertex)),
                       mesh.vertices.data(), 0);
  glCreateBuffers(1, &indices_);
  glNamedBufferStorage(indices_, static_cast<GLsizeiptr>(mesh.indices.size() * sizeof(std::uint32_t)),
                       mesh.indices.data(), 0);
  if (glGetError() != GL_NO_ERROR) {
    throw Error("OpenGL", "the graphics driver cannot allocate memory for a mesh", "simplify the mesh");
  }
  glCreateVertexArrays(1, &vertex_array_);
  glVertexArrayVertexBuffer(vertex_array_, 0, vertices_, 0, sizeof(SurfaceVertex));
  glVertexArrayElementBuffer(vertex_array_, indices_);
  describe(vertex_array_, 0, 3, offsetof(SurfaceVertex, position));
  describe(vertex_array_, 1, 3, offsetof(SurfaceVertex, normal));
  describe(vertex_array_, 2, 2, offsetof(SurfaceVertex, texture));
  describe(vertex_array_, 3, 3, offsetof(SurfaceVertex, color));
}

GlMesh::~GlMesh() {
  glDeleteVertexArrays(1, &vertex_array_);
  glDeleteBuffers(1, &vertices_);
  glDeleteBuffers(1, &indices_);
  for (const Part& part : parts_) {
    if (part.image != 0) {
      glDeleteTextures(1, &part.image);
    }
  }
}

void GlMesh::bind() const {
  glBindVertexArray(vertex_array_);
  glPatchParameteri(GL_PATCH_VERTICES, 3);
}

void GlMesh::draw(const Part& part, double max_level) const {
  const std::uint32_t maximum = in_software_ ? 3 * software_patches(max_level) : part.index_count;
  for (std::uint32_t first = 0; first < part.index_count; first += maximum) {
    const auto offset = std::size_t{part.first_index + first} * sizeof(std::uint32_t);
    glDrawElements(GL_PATCHES, static_cast<GLsizei>(std::min(maximum, part.index_count - first)), GL_UNSIGNED_INT,
                   reinterpret_cast<const void*>(offset));  // NOLINT(performance-no-int-to-ptr)
  }
}

}  // namespace ergodome
