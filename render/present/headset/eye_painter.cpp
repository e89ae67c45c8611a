#include "render/present/headset/eye_painter.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>
#include <vector>

#include "render/opengl/gl_program.h"
#include "render/output/text_image.h"
#include "render/present/caption_texture.h"
#include "render/present/headset/eye_shader.h"
#include "render/present/headset/star_view.h"

namespace ergodome {

namespace {

//! Uniform locations of the shader; 1 and 2 belong to the tone.
enum Location : GLint {
  sky_from_eye = 0,
  room_from_eye = 3,
  tangents = 4,
  eye_position = 5,
  lighting = 6,
  flags = 7,
  vignette = 8,
  floor_middle = 9,
  panel_middle = 10,  // two panels
  panel_right = 12,
  panel_up = 14,
  panel_rows = 16,
};

//! Distance of the panels from the middle of the rest frame [m], and the heights of their middles
//! above the floor.
constexpr double panel_distance_m = 2.0;
constexpr double caption_height_m = 1.15;
constexpr double text_height_m = 1.75;
constexpr int text_px = 28;
constexpr double meters_per_text_px = 0.0016;

glm::mat3 matrix(const glm::dquat& turn) { return glm::mat3(glm::mat3_cast(turn)); }

}  // namespace

struct EyePainter::State {
  GLuint program = 0;
  GLuint vertex_array = 0;
  GLuint text = 0;
  GLuint black = 0;  //!< cube map of one black texel, for the time before the first picture
  int text_width = 0;
  int text_height = 0;
  std::string words;
  CaptionTexture captions;
  StarView stars;

  void set_panels(const HeadsetScene& scene) const;
};

EyePainter::EyePainter() : state_(std::make_unique<State>()) {
  require_gl_45();
  state_->program =
      linked_program(whole_viewport_source, std::string(tone_source) + encoding_source + eye_shader_source);
  glCreateVertexArrays(1, &state_->vertex_array);
  glCreateTextures(GL_TEXTURE_CUBE_MAP, 1, &state_->black);
  glTextureStorage2D(state_->black, 1, GL_RGBA8, 1, 1);
  constexpr float nothing[4] = {};
  glClearTexImage(state_->black, 0, GL_RGBA, GL_FLOAT, nothing);
}

EyePainter::~EyePainter() {
  glDeleteTextures(1, &state_->text);
  glDeleteTextures(1, &state_->black);
  glDeleteVertexArrays(1, &state_->vertex_array);
  glDeleteProgram(state_->program);
}

void EyePainter::set_captions(const LaidCaptions& captions) { state_->captions.set(captions); }

void EyePainter::set_text(const std::string& text) {
  State& state = *state_;
  if (text == state.words) {
    return;
  }
  state.words = text;
  glDeleteTextures(1, &state.text);
  state.text = 0;
  const bool columns = text.find('\t') != std::string::npos;
  const TextImage image =
      text_lines_image(text, text_px, columns ? TextFace::monospaced : TextFace::proportional, columns ? 0 : 1200);
  if (image.width == 0) {
    return;
  }
  // White letters on a dark panel through which the sky is still visible.
  constexpr float ground = 0.65F;
  std::vector<float> rgba;
  rgba.reserve(4 * image.coverage.size());
  for (const float letter : image.coverage) {
    const float alpha = letter + (1.0F - letter) * ground;
    rgba.insert(rgba.end(), {letter, letter, letter, alpha});
  }
  glCreateTextures(GL_TEXTURE_2D, 1, &state.text);
  glTextureStorage2D(state.text, 1, GL_RGBA8, image.width, image.height);
  glTextureSubImage2D(state.text, 0, 0, 0, image.width, image.height, GL_RGBA, GL_FLOAT, rgba.data());
  glTextureParameteri(state.text, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTextureParameteri(state.text, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTextureParameteri(state.text, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  state.text_width = image.width;
  state.text_height = image.height;
}

void EyePainter::State::set_panels(const HeadsetScene& scene) const {
  const glm::dvec3 forward(-std::sin(scene.facing_rad), 0.0, -std::cos(scene.facing_rad));
  const glm::dvec3 right(std::cos(scene.facing_rad), 0.0, -std::sin(scene.facing_rad));
  const glm::dvec3 foot = glm::dvec3(scene.middle_m.x, scene.floor_m, scene.middle_m.z) + panel_distance_m * forward;
  const auto set = [&](int panel, double height_m, double half_width_m, double half_height_m) {
    const glm::vec3 middle(foot + glm::dvec3(0.0, height_m, 0.0));
    const glm::vec3 across(right / std::max(half_width_m, 1e-6));
    const glm::vec3 along(0.0F, static_cast<float>(1.0 / std::max(half_height_m, 1e-6)), 0.0F);
    glUniform3fv(panel_middle + panel, 1, glm::value_ptr(middle));
    glUniform3fv(panel_right + panel, 1, glm::value_ptr(across));
    glUniform3fv(panel_up + panel, 1, glm::value_ptr(along));
  };
  const bool has_captions = scene.panels && captions.use(1);
  const double half_width_m = panel_distance_m * caption_panel_half_width;
  set(0, caption_height_m, half_width_m, half_width_m / caption_panel_aspect);
  glUniform3f(panel_rows, has_captions ? captions.first_row_part() : 0.0F, has_captions ? captions.row_part() : 1.0F,
              has_captions ? captions.opacity() : 0.0F);
  const bool has_text = scene.panels && text != 0;
  glBindTextureUnit(2, text);
  set(1, text_height_m, 0.5 * meters_per_text_px * text_width, 0.5 * meters_per_text_px * text_height);
  glUniform3f(panel_rows + 1, 0.0F, 1.0F, has_text ? 1.0F : 0.0F);
}

void EyePainter::draw(const Panorama& panorama, int eye, const HeadsetEye& view, const HeadsetScene& scene,
                      ImageSize size, bool encoded) const {
  State& state = *state_;
  glDisable(GL_FRAMEBUFFER_SRGB);
  const glm::mat3 sky = matrix(glm::conjugate(panorama.turn()) * scene.level_from_room * view.turn);
  const glm::vec4 sides(view.sides.left, view.sides.right, view.sides.down, view.sides.up);
  const bool has_stars = panorama.stars(eye) != nullptr;
  if (has_stars) {
    glBindTextureUnit(3, state.stars.draw(panorama, eye, sky, sides, size));
  }
  glViewport(0, 0, size.width, size.height);
  glUseProgram(state.program);
  glBindVertexArray(state.vertex_array);
  if (panorama.empty()) {
    glBindTextureUnit(0, state.black);
  } else {
    panorama.use(eye, 0);
  }
  set_tone(panorama.tone());
  const glm::mat3 room = matrix(view.turn);
  glUniformMatrix3fv(sky_from_eye, 1, GL_FALSE, glm::value_ptr(sky));
  glUniformMatrix3fv(room_from_eye, 1, GL_FALSE, glm::value_ptr(room));
  glUniform4fv(tangents, 1, glm::value_ptr(sides));
  const glm::vec3 position(view.position_m);
  glUniform3fv(eye_position, 1, glm::value_ptr(position));
  glUniform2f(lighting, static_cast<float>(scene.light), static_cast<float>(std::exp2(scene.exposure_stops)));
  glUniform4i(flags, panorama.heat_map() ? 1 : 0, scene.rest_frame ? 1 : 0, encoded ? 1 : 0, has_stars ? 1 : 0);
  glUniform2f(vignette, static_cast<float>(scene.vignette), static_cast<float>(scene.clear_half_angle_rad));
  glUniform3f(floor_middle, static_cast<float>(scene.middle_m.x), static_cast<float>(scene.floor_m),
              static_cast<float>(scene.middle_m.z));
  state.set_panels(scene);
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace ergodome
