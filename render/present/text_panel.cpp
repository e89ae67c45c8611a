#include "render/present/text_panel.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <tuple>
#include <utility>

#include "render/present/gl_program.h"

namespace ergodome {

struct TextPanel::State {
  GLuint program = 0;
  GLuint vertex_array = 0;
  GLuint texture = 0;
  int width = 0;
  int height = 0;
  std::tuple<std::string, int, TextFace, int> shown;
};

namespace {

constexpr const char* panel_source = R"(#version 450 core
in vec2 place;
out vec4 colour;
layout(binding = 0) uniform sampler2D coverage;
void main() {
  float text = texture(coverage, vec2(place.x, 1.0 - place.y)).r;
  colour = vec4(mix(vec3(0.0), vec3(1.0, 0.85, 0.4), text), mix(0.7, 1.0, text));
}
)";

struct PanelCorner {
  int left;
  int bottom;
};

PanelCorner corner_of(PanelPlace place, std::pair<int, int> framebuffer, std::pair<int, int> panel, double raised) {
  const auto [width, height] = framebuffer;
  const int middle = (width - panel.first) / 2;
  switch (place) {
    case PanelPlace::top_left:
      return {0, height - panel.second};
    case PanelPlace::middle:
      return {middle, (height - panel.second) / 2};
    case PanelPlace::bottom_middle:
      return {middle, std::max(height / 20, static_cast<int>(raised * height))};
    default:
      return {middle, height - height / 20 - panel.second};
  }
}

}  // namespace

TextPanel::TextPanel() : state_(std::make_unique<State>()) {
  state_->program = linked_program(whole_viewport_source, panel_source);
  glCreateVertexArrays(1, &state_->vertex_array);
}

TextPanel::~TextPanel() {
  glDeleteTextures(1, &state_->texture);
  glDeleteVertexArrays(1, &state_->vertex_array);
  glDeleteProgram(state_->program);
}

void TextPanel::set(const std::string& text, int font_px, TextFace face, int widest_px) {
  if (std::tie(text, font_px, face, widest_px) == state_->shown) {
    return;
  }
  state_->shown = {text, font_px, face, widest_px};
  const TextImage image = text_lines_image(text, font_px, face, widest_px);
  glDeleteTextures(1, &state_->texture);
  state_->texture = 0;
  state_->width = image.width;
  state_->height = image.height;
  if (text.empty() || image.width == 0) {
    return;
  }
  glCreateTextures(GL_TEXTURE_2D, 1, &state_->texture);
  glTextureStorage2D(state_->texture, 1, GL_R8, image.width, image.height);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  glTextureSubImage2D(state_->texture, 0, 0, 0, image.width, image.height, GL_RED, GL_FLOAT, image.coverage.data());
  glTextureParameteri(state_->texture, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTextureParameteri(state_->texture, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
}

int TextPanel::height_px() const { return state_->texture == 0 ? 0 : state_->height; }

void TextPanel::draw(int framebuffer_width, int framebuffer_height, PanelPlace place, double raised) {
  if (state_->texture == 0) {
    return;
  }
  const PanelCorner at =
      corner_of(place, {framebuffer_width, framebuffer_height}, {state_->width, state_->height}, raised);
  glViewport(at.left, at.bottom, state_->width, state_->height);
  glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  glUseProgram(state_->program);
  glBindTextureUnit(0, state_->texture);
  glBindVertexArray(state_->vertex_array);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glDisable(GL_BLEND);
}

}  // namespace ergodome
