#include "render/present/projectors/display_light.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <bit>
#include <string>

#include "render/opengl/gl_program.h"

namespace ergodome {

struct DisplayLight::State {
  GLuint program = 0;
  GLuint vertex_array = 0;
  GLuint framebuffer = 0;
  GLuint texture = 0;
  int width = 0;
  int height = 0;
  GLsync made = nullptr;  //!< a fence that is signaled when the texture is complete
};

namespace {

constexpr const char* light_source = R"(
out vec4 light;
layout(binding = 0) uniform sampler2D picture;
layout(location = 0) uniform bool heat_map;
layout(location = 3) uniform float dimmed;
void main() {
  // Reads pixel by pixel; rows are in the same order as in the picture, top row first.
  vec3 seen = max(texelFetch(picture, ivec2(gl_FragCoord.xy), 0).rgb, vec3(0.0));
  light = vec4(dimmed * clamp(heat_map ? seen : toned(seen), 0.0, 1.0), 1.0);
}
)";

//! Coarsest mipmap level; a texel of level n averages 2^n x 2^n pixels. No realistic warp needs
//! more.
constexpr int coarsest_level = 5;

}  // namespace

DisplayLight::DisplayLight() : state_(std::make_unique<State>()) {
  require_gl_45();
  state_->program = linked_program(whole_viewport_source, std::string(tone_source) + light_source);
  glCreateVertexArrays(1, &state_->vertex_array);
  glCreateFramebuffers(1, &state_->framebuffer);
}

DisplayLight::~DisplayLight() {
  glDeleteSync(state_->made);
  glDeleteTextures(1, &state_->texture);
  glDeleteFramebuffers(1, &state_->framebuffer);
  glDeleteVertexArrays(1, &state_->vertex_array);
  glDeleteProgram(state_->program);
}

void DisplayLight::resize(int width, int height) {
  if (state_->texture != 0 && state_->width == width && state_->height == height) {
    return;
  }
  glDeleteTextures(1, &state_->texture);
  glCreateTextures(GL_TEXTURE_2D, 1, &state_->texture);
  const int levels =
      std::min(static_cast<int>(std::bit_width(static_cast<unsigned>(std::max(width, height)))), coarsest_level + 1);
  glTextureStorage2D(state_->texture, levels, GL_RGBA16F, width, height);
  glTextureParameteri(state_->texture, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTextureParameteri(state_->texture, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTextureParameteri(state_->texture, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTextureParameteri(state_->texture, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  if (epoxy_has_gl_extension("GL_EXT_texture_filter_anisotropic") && !draws_in_software()) {
    // Maximum anisotropy of the filter. Near a dome's rim, pixels of a projector are several times
    // longer than wide. In software, anisotropic filtering takes three times as long.
    constexpr float longest = 4.0F;
    glTextureParameterf(state_->texture, GL_TEXTURE_MAX_ANISOTROPY_EXT, longest);
  }
  glNamedFramebufferTexture(state_->framebuffer, GL_COLOR_ATTACHMENT0, state_->texture, 0);
  state_->width = width;
  state_->height = height;
}

void DisplayLight::update(const PresentedPicture& picture) {
  if (picture.texture == 0) {
    return;
  }
  resize(picture.width, picture.height);
  GLint before = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &before);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, state_->framebuffer);
  glViewport(0, 0, picture.width, picture.height);
  glUseProgram(state_->program);
  glUniform1i(0, picture.heat_map ? 1 : 0);
  set_tone(picture.tone);
  glUniform1f(3, picture.light);
  glBindTextureUnit(0, picture.texture);
  glBindVertexArray(state_->vertex_array);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(before));
  glGenerateTextureMipmap(state_->texture);
  glDeleteSync(state_->made);
  state_->made = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
  // Other contexts wait for the fence, so it must be submitted.
  glFlush();
}

bool DisplayLight::use(unsigned unit) const {
  if (state_->texture == 0) {
    return false;
  }
  glWaitSync(state_->made, 0, GL_TIMEOUT_IGNORED);
  glBindTextureUnit(unit, state_->texture);
  return true;
}

}  // namespace ergodome
