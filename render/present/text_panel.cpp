#include "render/present/text_panel.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <sstream>
#include <utility>
#include <vector>

#include "render/output/caption.h"
#include "render/present/gl_program.h"

namespace ergodome {

struct TextPanel::State {
  GLuint program = 0;
  GLuint vertex_array = 0;
  GLuint texture = 0;
  int width = 0;
  int height = 0;
  std::pair<std::string, int> shown;
};

namespace {

constexpr const char* fragment_source = R"(#version 450 core
in vec2 place;
out vec4 colour;
layout(binding = 0) uniform sampler2D coverage;
void main() {
  float text = texture(coverage, vec2(place.x, 1.0 - place.y)).r;
  colour = vec4(mix(vec3(0.0), vec3(1.0, 0.85, 0.4), text), mix(0.7, 1.0, text));
}
)";

//! Lines one below the other, each as text_image draws it, with room about them.
TextImage lines_image(const std::string& text, int font_px) {
  const int line_px = font_px * 3 / 2;
  const int margin_px = font_px / 2;
  std::vector<TextImage> lines;
  TextImage image{0, 2 * margin_px, {}};
  std::stringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    lines.push_back(text_image(line, font_px));
    image.width = std::max(image.width, lines.back().width + 2 * margin_px);
    image.height += line_px;
  }
  image.coverage.resize(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const int top = margin_px + static_cast<int>(i) * line_px;
    for (int y = 0; y < std::min(lines[i].height, line_px); ++y) {
      const auto from = lines[i].coverage.begin() + static_cast<std::ptrdiff_t>(y) * lines[i].width;
      std::copy_n(from, lines[i].width,
                  image.coverage.begin() + static_cast<std::ptrdiff_t>(top + y) * image.width + margin_px);
    }
  }
  return image;
}

}  // namespace

TextPanel::TextPanel() : state_(std::make_unique<State>()) {
  state_->program = linked_program(whole_viewport_source, fragment_source);
  glCreateVertexArrays(1, &state_->vertex_array);
}

TextPanel::~TextPanel() {
  glDeleteTextures(1, &state_->texture);
  glDeleteVertexArrays(1, &state_->vertex_array);
  glDeleteProgram(state_->program);
}

void TextPanel::set(const std::string& text, int font_px) {
  if (std::pair(text, font_px) == state_->shown) {
    return;
  }
  state_->shown = {text, font_px};
  const TextImage image = lines_image(text, font_px);
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

void TextPanel::draw(int framebuffer_width, int framebuffer_height) {
  if (state_->texture == 0) {
    return;
  }
  glViewport((framebuffer_width - state_->width) / 2, (framebuffer_height - state_->height) / 2, state_->width,
             state_->height);
  glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  glUseProgram(state_->program);
  glBindTextureUnit(0, state_->texture);
  glBindVertexArray(state_->vertex_array);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glDisable(GL_BLEND);
}

}  // namespace ergodome
