#include "render/present/text_panel.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>
#include <vector>

#include "render/opengl/gl_program.h"
#include "render/output/text_image.h"

namespace ergodome {

struct TextPanel::State {
  GLuint program = 0;
  GLuint vertex_array = 0;
  GLuint texture = 0;
  int width = 0;
  int height = 0;
  PanelGround ground = PanelGround::dark;
  std::tuple<std::string, int, TextFace, int> shown;
};

namespace {

constexpr const char* panel_source = R"(#version 450 core
in vec2 place;
out vec4 colour;
layout(binding = 0) uniform sampler2D text;  // coverage by letters, darkness of the rim around them
layout(location = 0) uniform float ground;
void main() {
  vec2 here = texture(text, vec2(place.x, 1.0 - place.y)).rg;
  colour = vec4(here.r * vec3(1.0, 0.85, 0.4), here.r + (1.0 - here.r) * max(here.g, ground));
}
)";

constexpr float dark_ground = 0.75F;

struct PanelCorner {
  double left;
  double bottom;
};

//! Returns the position of the panel's lower left corner in the area; sizes are in pixels of text.
PanelCorner corner_of(PanelPosition position, std::pair<double, double> area, std::pair<double, double> panel,
                      double raised) {
  const auto [width, height] = area;
  const double middle = 0.5 * (width - panel.first);
  switch (position) {
    case PanelPosition::top_left:
      return {0.0, height - panel.second};
    case PanelPosition::middle:
      return {middle, 0.5 * (height - panel.second)};
    case PanelPosition::bottom_middle:
      return {middle, std::max(height / 20.0, raised * height)};
    default:
      return {middle, height - height / 20.0 - panel.second};
  }
}

//! Returns letters and their rim, two values per pixel.
std::vector<float> with_rim(const TextImage& image, int font_px) {
  const std::vector<float> rim = text_rim(image.coverage, image.width, image.height, text_rim_reach_px(font_px));
  std::vector<float> both;
  both.reserve(2 * rim.size());
  for (std::size_t i = 0; i < rim.size(); ++i) {
    both.push_back(image.coverage[i]);
    both.push_back(rim[i]);
  }
  return both;
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

void TextPanel::set(const std::string& text, int font_px, TextFace face, int widest_px, PanelGround ground) {
  state_->ground = ground;
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
  glTextureStorage2D(state_->texture, 1, GL_RG8, image.width, image.height);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  glTextureSubImage2D(state_->texture, 0, 0, 0, image.width, image.height, GL_RG, GL_FLOAT,
                      with_rim(image, font_px).data());
  glTextureParameteri(state_->texture, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTextureParameteri(state_->texture, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
}

void TextPanel::draw(const PanelArea& area, PanelPosition position, double raised) {
  if (state_->texture == 0) {
    return;
  }
  const PanelCorner at = corner_of(position, {area.width / area.across, area.height / area.along},
                                   {state_->width, state_->height}, raised);
  const auto px = [](double value) { return static_cast<int>(std::lround(value)); };
  glViewport(area.left + px(at.left * area.across), area.bottom + px(at.bottom * area.along),
             px(state_->width * area.across), px(state_->height * area.along));
  // Clips text that is larger than the part of the window for one eye.
  glEnable(GL_SCISSOR_TEST);
  glScissor(area.left, area.bottom, area.width, area.height);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glUseProgram(state_->program);
  glUniform1f(0, state_->ground == PanelGround::dark ? dark_ground : 0.0F);
  glBindTextureUnit(0, state_->texture);
  glBindVertexArray(state_->vertex_array);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glDisable(GL_BLEND);
  glDisable(GL_SCISSOR_TEST);
}

void TextPanel::draw(int framebuffer_width, int framebuffer_height, PanelPosition position, double raised) {
  draw({0, 0, framebuffer_width, framebuffer_height}, position, raised);
}

}  // namespace ergodome
