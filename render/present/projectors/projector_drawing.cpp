#include "render/present/projectors/projector_drawing.h"

#include <epoxy/gl.h>

#include <cstdint>
#include <string>

#include "render/opengl/gl_program.h"
#include "render/present/projectors/projector_mesh.h"

namespace ergodome {

struct ProjectorDrawing::State {
  GLuint program = 0;
  GLuint captions_program = 0;  //!< program that draws captions; 0 until it is needed
  std::string masks;            //!< definitions of HAS_BLEND and HAS_BLACK_LEVEL for the shader
  GLuint vertex_array = 0;
  GLuint vertices = 0;
  GLuint indices = 0;
  GLsizei index_count = 0;
  GLuint blend = 0;
  GLuint black_level = 0;
  Vector3<float> lift{};
  Vector3<float> gain{};
  float gamma = 2.2F;
};

namespace {

//! With HAS_CAPTIONS, only the rows that contain captions are drawn.
constexpr const char* vertex_source = R"(
layout(location = 0) in vec2 place;   // on the raster, y down
layout(location = 1) in vec2 source;  // in the master, its top at 0
layout(location = 2) in vec2 mask;    // in the masks
layout(location = 3) in float factor;
out vec2 source_place;
out vec2 mask_place;
out float intensity;
#ifdef HAS_CAPTIONS
layout(location = 3) uniform vec2 caption_rows;  // captions within the master: first row, fraction of the rows
out float gl_ClipDistance[2];
#endif
void main() {
#ifdef HAS_CAPTIONS
  gl_ClipDistance[0] = source.y - caption_rows.x;
  gl_ClipDistance[1] = caption_rows.x + caption_rows.y - source.y;
#endif
  source_place = source;
  mask_place = mask;
  intensity = factor;
  gl_Position = vec4(2.0 * place.x - 1.0, 1.0 - 2.0 * place.y, 0.0, 1.0);
}
)";

//! HAS_BLEND and HAS_BLACK_LEVEL are defined if the projector has these masks. With HAS_CAPTIONS,
//! only pixels that captions cover are drawn.
constexpr const char* projector_source = R"(
in vec2 source_place;
in vec2 mask_place;
in float intensity;
out vec4 colour;
layout(binding = 0) uniform sampler2D master;  // toned, linear
layout(binding = 1) uniform sampler2D blend;
layout(binding = 2) uniform sampler2D black_level;
layout(location = 0) uniform vec3 lift;
layout(location = 1) uniform vec3 gain;
layout(location = 2) uniform float gamma;
#ifdef HAS_CAPTIONS
layout(binding = 3) uniform sampler2D captions;  // light of the display times coverage
layout(location = 3) uniform vec2 caption_rows;
layout(location = 4) uniform float opacity;
layout(location = 5) uniform float dimmed;
#endif
void main() {
  vec3 light = texture(master, source_place).rgb;
#ifdef HAS_CAPTIONS
  vec4 caption = opacity * texture(captions, vec2(source_place.x, (source_place.y - caption_rows.x) / caption_rows.y));
  if (caption.a == 0.0) {
    discard;
  }
  light = light * (1.0 - caption.a) + dimmed * caption.rgb;
#endif
  // The rim of the domemaster must not be repeated beyond it.
  light *= float(all(greaterThanEqual(source_place, vec2(0.0))) && all(lessThanEqual(source_place, vec2(1.0))));
  // tests/render/present/projectors/projector_light.h computes the same.
  vec3 blended = light * intensity;
#ifdef HAS_BLEND
  blended *= texture(blend, mask_place).rgb;
#endif
  vec3 beta = lift;
#ifdef HAS_BLACK_LEVEL
  beta *= texture(black_level, mask_place).rgb;
#endif
  vec3 lifted = blended * (1.0 - beta) + beta;
  colour = vec4(pow(clamp(gain * lifted, 0.0, 1.0), vec3(1.0 / gamma)), 1.0);
}
)";

GLuint projector_program(const std::string& definitions) {
  const std::string head = "#version 450 core\n" + definitions;
  return linked_program(head + vertex_source, head + projector_source);
}

Vector3<float> converted(const Vector3<double>& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

//! Creates a texture of a mask, filtered in linear light; returns 0 if there is no mask.
GLuint mask_texture(const BlendMap& shown) {
  if (shown.width == 0) {
    return 0;
  }
  const bool grey = shown.channels == 1;
  GLuint texture = 0;
  glCreateTextures(GL_TEXTURE_2D, 1, &texture);
  glTextureStorage2D(texture, 1, grey ? GL_R32F : GL_RGB32F, shown.width, shown.height);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  glTextureSubImage2D(texture, 0, 0, 0, shown.width, shown.height, grey ? GL_RED : GL_RGB, GL_FLOAT,
                      shown.values.data());
  glTextureParameteri(texture, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTextureParameteri(texture, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTextureParameteri(texture, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTextureParameteri(texture, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  if (grey) {
    constexpr GLint everywhere[] = {GL_RED, GL_RED, GL_RED, GL_ONE};
    glTextureParameteriv(texture, GL_TEXTURE_SWIZZLE_RGBA, everywhere);
  }
  return texture;
}

void set_attribute(GLuint vertex_array, GLuint attribute, int size, std::size_t offset) {
  glEnableVertexArrayAttrib(vertex_array, attribute);
  glVertexArrayAttribFormat(vertex_array, attribute, size, GL_FLOAT, GL_FALSE, static_cast<GLuint>(offset));
  glVertexArrayAttribBinding(vertex_array, attribute, 0);
}

}  // namespace

ProjectorDrawing::ProjectorDrawing(const ProjectorPicture& picture) : state_(std::make_unique<State>()) {
  require_gl_45();
  state_->masks = std::string(picture.blend.width > 0 ? "#define HAS_BLEND\n" : "") +
                  (picture.black_level.width > 0 ? "#define HAS_BLACK_LEVEL\n" : "");
  state_->program = projector_program(state_->masks);
  glCreateVertexArrays(1, &state_->vertex_array);
  set_attribute(state_->vertex_array, 0, 2, offsetof(MeshVertex, position));
  set_attribute(state_->vertex_array, 1, 2, offsetof(MeshVertex, source));
  set_attribute(state_->vertex_array, 2, 2, offsetof(MeshVertex, mask));
  set_attribute(state_->vertex_array, 3, 1, offsetof(MeshVertex, factor));
  state_->blend = mask_texture(picture.blend);
  state_->black_level = mask_texture(picture.black_level);
  set_warp(picture.warp, picture.offsets);
  set_colour(picture);
}

ProjectorDrawing::~ProjectorDrawing() {
  const GLuint textures[] = {state_->blend, state_->black_level};
  glDeleteTextures(2, textures);
  const GLuint buffers[] = {state_->vertices, state_->indices};
  glDeleteBuffers(2, buffers);
  glDeleteVertexArrays(1, &state_->vertex_array);
  glDeleteProgram(state_->captions_program);
  glDeleteProgram(state_->program);
}

void ProjectorDrawing::set_warp(const WarpMesh& warp, const GridOffsets& grid) {
  const auto [vertices, indices] = projector_mesh(warp, grid);
  const GLuint before[] = {state_->vertices, state_->indices};
  glDeleteBuffers(2, before);
  glCreateBuffers(1, &state_->vertices);
  glCreateBuffers(1, &state_->indices);
  glNamedBufferStorage(state_->vertices, static_cast<GLsizeiptr>(vertices.size() * sizeof(MeshVertex)), vertices.data(),
                       0);
  glNamedBufferStorage(state_->indices, static_cast<GLsizeiptr>(indices.size() * sizeof(std::uint32_t)), indices.data(),
                       0);
  glVertexArrayVertexBuffer(state_->vertex_array, 0, state_->vertices, 0, sizeof(MeshVertex));
  glVertexArrayElementBuffer(state_->vertex_array, state_->indices);
  state_->index_count = static_cast<GLsizei>(indices.size());
}

void ProjectorDrawing::set_colour(const ProjectorPicture& picture) {
  state_->lift = converted(picture.black_level_lift);
  state_->gain = converted(picture.gain);
  state_->gamma = static_cast<float>(picture.gamma);
}

void ProjectorDrawing::draw(const DisplayLight& light, int framebuffer_width, int framebuffer_height) {
  glViewport(0, 0, framebuffer_width, framebuffer_height);
  glClearColor(0.0F, 0.0F, 0.0F, 1.0F);
  glClear(GL_COLOR_BUFFER_BIT);
  if (framebuffer_width <= 0 || framebuffer_height <= 0 || !light.use(0)) {
    return;
  }
  draw_mesh(state_->program, 0);
}

void ProjectorDrawing::draw_captions(const CaptionTexture& captions, float dimmed, const DisplayLight& light,
                                     int framebuffer_width, int framebuffer_height) {
  if (framebuffer_width <= 0 || framebuffer_height <= 0 || !light.use(0) || !captions.use(3)) {
    return;
  }
  if (state_->captions_program == 0) {
    state_->captions_program = projector_program("#define HAS_CAPTIONS\n" + state_->masks);
  }
  glViewport(0, 0, framebuffer_width, framebuffer_height);
  glUseProgram(state_->captions_program);
  glUniform2f(3, captions.first_row_part(), captions.row_part());
  glUniform1f(4, captions.opacity());
  glUniform1f(5, dimmed);
  glEnable(GL_CLIP_DISTANCE0);
  glEnable(GL_CLIP_DISTANCE1);
  // Skips the triangles of the backdrop, which show no part of the domemaster.
  draw_mesh(state_->captions_program, backdrop_indices);
  glDisable(GL_CLIP_DISTANCE0);
  glDisable(GL_CLIP_DISTANCE1);
}

void ProjectorDrawing::draw_mesh(unsigned program, int first_index) {
  glUseProgram(program);
  glUniform3f(0, state_->lift.x, state_->lift.y, state_->lift.z);
  glUniform3f(1, state_->gain.x, state_->gain.y, state_->gain.z);
  glUniform1f(2, state_->gamma);
  glBindTextureUnit(1, state_->blend);
  glBindTextureUnit(2, state_->black_level);
  glBindVertexArray(state_->vertex_array);
  const auto offset = static_cast<std::uintptr_t>(first_index) * sizeof(std::uint32_t);
  glDrawElements(GL_TRIANGLES, state_->index_count - first_index, GL_UNSIGNED_INT,
                 reinterpret_cast<const void*>(offset));  // NOLINT(performance-no-int-to-ptr): OpenGL's offset
}

}  // namespace ergodome
