#include "render/present/headset/star_view.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cstddef>
#include <glm/gtc/type_ptr.hpp>
#include <utility>

#include "render/opengl/gl_program.h"

namespace ergodome {

namespace {

//! Smallest standard deviation of a spot [px]: a smaller one shows the same pixels.
constexpr double least_sigma_px = 0.05;

const char* const panorama_view_source = R"(#version 450 core
in vec2 place;
out vec4 light_and_clear;
layout(binding = 0) uniform samplerCube sky;
layout(location = 0) uniform mat3 sky_from_eye;
layout(location = 3) uniform vec4 tangents;
void main() {
  vec3 far = sky_from_eye * vec3(mix(tangents.x, tangents.y, place.x), mix(tangents.z, tangents.w, place.y), -1.0);
  vec4 seen = textureLod(sky, vec3(far.xy, -far.z), 0.0);
  light_and_clear = vec4(clamp(seen.rgb, vec3(0.0), vec3(30000.0)), clamp(1.0 - seen.a, 0.0, 1.0));
}
)";

// One star per instance: a square of whole pixels that its spot reaches.
const char* const star_vertex_source = R"(#version 450 core
layout(location = 0) in vec3 direction;
layout(location = 1) in vec3 light;
layout(location = 0) uniform mat3 eye_from_sky;
layout(location = 3) uniform vec4 tangents;
layout(location = 4) uniform vec2 size;
layout(location = 5) uniform vec2 spot;  // standard deviation, reach
flat out vec2 middle;
flat out vec3 value;
void main() {
  vec3 view = eye_from_sky * direction;
  vec2 extent = tangents.yw - tangents.xz;
  middle = (view.xy / max(-view.z, 1e-6) - tangents.xz) / extent * size;
  // The light divided by the solid angle of a pixel there.
  float solid_angle = extent.x / size.x * extent.y / size.y * -view.z * view.z * view.z;
  value = light / max(solid_angle, 1e-12);
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  vec2 pixel = mix(floor(middle - spot.y), floor(middle + spot.y) + 1.0, corner);
  bool seen = view.z < -1e-3;
  gl_Position = seen ? vec4(2.0 * pixel / size - 1.0, 0.0, 1.0) : vec4(2.0, 2.0, 2.0, 1.0);
}
)";

const char* const star_fragment_source = R"(#version 450 core
layout(location = 5) uniform vec2 spot;
flat in vec2 middle;
flat in vec3 value;
out vec4 light;

// The error function to 2e-7 (Abramowitz and Stegun, equation 7.1.26).
vec2 error_function(vec2 x) {
  vec2 t = 1.0 / (1.0 + 0.3275911 * abs(x));
  vec2 p = t * (0.254829592 + t * (-0.284496736 + t * (1.421413741 + t * (-1.453152027 + t * 1.061405429))));
  return sign(x) * (1.0 - p * exp(-x * x));
}

// The part of a spot in a pixel; the parts of all pixels add up to 1 (as PointSpread in
// render/passes/stars).
void main() {
  vec2 low = clamp(gl_FragCoord.xy - 0.5 - middle, -spot.y, spot.y);
  vec2 high = clamp(gl_FragCoord.xy + 0.5 - middle, -spot.y, spot.y);
  float narrower = 0.70710678 / spot.x;
  vec2 part = 0.5 * (error_function(high * narrower) - error_function(low * narrower)) /
              error_function(vec2(spot.y * narrower));
  light = vec4(min(part.x * part.y * value, vec3(30000.0)), 0.0);
}
)";

}  // namespace

struct StarView::State {
  //! A texture of linear light, for views of one size.
  struct Target {
    ImageSize size{0, 0};
    GLuint texture = 0;
    GLuint framebuffer = 0;
  };

  GLuint sky_program = 0;
  GLuint star_program = 0;
  GLuint nothing = 0;  //!< vertex array without attributes
  GLuint stars = 0;    //!< vertex array of StarLight
  Target targets[2];   //!< for the headset and the mirror; the last one used is first

  const Target& target(ImageSize size);
};

namespace {

void make_target(ImageSize size, GLuint& texture, GLuint& framebuffer) {
  glCreateTextures(GL_TEXTURE_2D, 1, &texture);
  glTextureStorage2D(texture, 1, GL_RGBA16F, size.width, size.height);
  glCreateFramebuffers(1, &framebuffer);
  glNamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, texture, 0);
}

GLuint make_star_array() {
  GLuint array = 0;
  glCreateVertexArrays(1, &array);
  const GLuint offsets[] = {offsetof(StarLight, direction), offsetof(StarLight, light)};
  for (const GLuint attribute : {0U, 1U}) {
    glEnableVertexArrayAttrib(array, attribute);
    glVertexArrayAttribFormat(array, attribute, 3, GL_FLOAT, GL_FALSE, offsets[attribute]);
    glVertexArrayAttribBinding(array, attribute, 0);
  }
  glVertexArrayBindingDivisor(array, 0, 1);
  return array;
}

}  // namespace

const StarView::State::Target& StarView::State::target(ImageSize size) {
  if (targets[0].size != size) {
    std::swap(targets[0], targets[1]);
  }
  if (targets[0].size != size) {
    glDeleteFramebuffers(1, &targets[0].framebuffer);
    glDeleteTextures(1, &targets[0].texture);
    targets[0].size = size;
    make_target(size, targets[0].texture, targets[0].framebuffer);
  }
  return targets[0];
}

StarView::StarView() : state_(std::make_unique<State>()) {
  state_->sky_program = linked_program(whole_viewport_source, panorama_view_source);
  state_->star_program = linked_program(star_vertex_source, star_fragment_source);
  glCreateVertexArrays(1, &state_->nothing);
  state_->stars = make_star_array();
}

StarView::~StarView() {
  for (const State::Target& target : state_->targets) {
    glDeleteFramebuffers(1, &target.framebuffer);
    glDeleteTextures(1, &target.texture);
  }
  glDeleteVertexArrays(1, &state_->nothing);
  glDeleteVertexArrays(1, &state_->stars);
  glDeleteProgram(state_->sky_program);
  glDeleteProgram(state_->star_program);
}

unsigned StarView::draw(const Panorama& panorama, int eye, const glm::mat3& sky_from_eye, const glm::vec4& tangents,
                        ImageSize size) {
  State& state = *state_;
  const State::Target& target = state.target(size);
  const PanoramaStars& stars = *panorama.stars(eye);
  GLint bound = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &bound);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, target.framebuffer);
  glViewport(0, 0, size.width, size.height);
  panorama.use(eye, 0);
  glUseProgram(state.sky_program);
  glBindVertexArray(state.nothing);
  glUniformMatrix3fv(0, 1, GL_FALSE, glm::value_ptr(sky_from_eye));
  glUniform4fv(3, 1, glm::value_ptr(tangents));
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glUseProgram(state.star_program);
  glBindVertexArray(state.stars);
  glVertexArrayVertexBuffer(state.stars, 0, stars.buffer, 0, sizeof(StarLight));
  glUniformMatrix3fv(0, 1, GL_TRUE, glm::value_ptr(sky_from_eye));
  glUniform4fv(3, 1, glm::value_ptr(tangents));
  glUniform2f(4, static_cast<float>(size.width), static_cast<float>(size.height));
  const double sigma_px = std::max(stars.sigma_px, least_sigma_px);
  glUniform2f(5, static_cast<float>(sigma_px), static_cast<float>(std::max(stars.cutoff_px, 3.0 * least_sigma_px)));
  glEnable(GL_BLEND);
  // The target's fourth channel is what remains of light from the sky.
  glBlendFuncSeparate(GL_DST_ALPHA, GL_ONE, GL_ZERO, GL_ONE);
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, stars.count);
  glDisable(GL_BLEND);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(bound));
  return target.texture;
}

}  // namespace ergodome
