#include "render/present/presenter.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>

#include "render/opengl/gl_program.h"
#include "render/output/tone_map.h"
#include "render/present/caption_texture.h"
#include "render/present/cuda_interop.h"

namespace ergodome {

struct Presenter::State {
  GLuint program = 0;
  GLuint encoded_program = 0;
  GLuint dimmed_program = 0;
  GLuint captions_program = 0;
  GLuint vertex_array = 0;
  GLuint texture = 0;
  int width = 0;
  int height = 0;
  bool encoded = false;  // the texture has display values
  bool heat_map = false;
  Tone tone;
  float light = 1.0F;
  long version = 0;
  std::unique_ptr<CudaTextureLink> link;
  CaptionTexture captions;
  EyeGrid eyes;

  //! Uploads a picture to a part of the texture.
  void fill(const Picture& picture, int left_px, int top_px) const {
    if (encoded) {
      glTextureSubImage2D(texture, 0, left_px, top_px, picture.width, picture.height, GL_RGBA, GL_UNSIGNED_BYTE,
                          tone_mapped_rgba(picture).data());
    } else {
      glTextureSubImage2D(texture, 0, left_px, top_px, picture.width, picture.height, GL_RGBA, GL_FLOAT,
                          picture.rgba.data());
    }
  }
};

namespace {

constexpr const char* captions_source = R"(#version 450 core
in vec2 place;
out vec4 colour;
layout(binding = 0) uniform sampler2D captions;  // light of the display times coverage
layout(location = 0) uniform vec2 rows;          // captions within the picture of an eye: first row, fraction of the rows
layout(location = 1) uniform float opacity;
layout(location = 2) uniform float dimmed;
vec3 encoded(vec3 light);
void main() {
  vec4 caption = texture(captions, vec2(place.x, (1.0 - place.y - rows.x) / rows.y));
  vec3 light = clamp(caption.rgb / max(caption.a, 1e-4), 0.0, 1.0);
  colour = opacity * caption.a * vec4(encoded(dimmed * light), 1.0);
}
)";

constexpr const char* window_source = R"(
in vec2 place;
out vec4 colour;
layout(binding = 0) uniform sampler2D picture;
layout(location = 0) uniform bool heat_map;
layout(location = 4) uniform float dimmed;
layout(location = 3) uniform vec2 part;  // part of the picture: begin, width
layout(location = 5) uniform int rows;   // framebuffer rows that alternate between this part and the next; 0: none
vec3 shown(vec3 texel);
void main() {
  // Counts rows from the top of the whole framebuffer, whichever part of it the picture fills.
  bool next = rows > 0 && (rows - 1 - int(gl_FragCoord.y)) % 2 == 1;
  float begin = part.x + (next ? part.y : 0.0);
  // Prevents the filter from reading the other eye's pixels at the edge between the halves.
  float half_texel = 0.5 / float(textureSize(picture, 0).x);
  float across = clamp(begin + part.y * place.x, begin + half_texel, begin + part.y - half_texel);
  // The picture's first row is its top.
  colour = vec4(shown(max(texture(picture, vec2(across, 1.0 - place.y)).rgb, vec3(0.0))), 1.0);
}
)";

// The function shown() of a window: for a picture of light, and for one of display values at full
// light and dimmed. They are programs of their own, because drivers that draw in software execute
// all branches of a program.
constexpr const char* window_light_source = R"(
vec3 shown(vec3 texel) {
  return encoded(dimmed * clamp(heat_map ? texel : toned(texel), 0.0, 1.0));
}
)";
constexpr const char* window_encoded_source = "vec3 shown(vec3 texel) { return texel; }\n";
constexpr const char* window_dimmed_source = R"(
vec3 shown(vec3 texel) {
  vec3 light = mix(texel / 12.92, pow((texel + 0.055) / 1.055, vec3(2.4)), greaterThan(texel, vec3(0.04045)));
  return encoded(dimmed * light);
}
)";

GLuint window_program(const char* shown_source) {
  return linked_program(whole_viewport_source,
                        std::string(tone_source) + encoding_source + window_source + shown_source);
}

//! Returns the width of a part of a picture, as a fraction of the picture's width.
double share_of(PicturePart part) { return part == PicturePart::whole ? 1.0 : 0.5; }

}  // namespace

Presenter::Presenter() : state_(std::make_unique<State>()) {
  require_gl_45();
  state_->program = window_program(window_light_source);
  state_->captions_program = linked_program(whole_viewport_source, std::string(captions_source) + encoding_source);
  glCreateVertexArrays(1, &state_->vertex_array);
}

Presenter::~Presenter() {
  state_->link.reset();
  glDeleteTextures(1, &state_->texture);
  glDeleteVertexArrays(1, &state_->vertex_array);
  glDeleteProgram(state_->captions_program);
  for (const GLuint program : {state_->program, state_->encoded_program, state_->dimmed_program}) {
    glDeleteProgram(program);
  }
}

void Presenter::encode_before_upload() {
  if (state_->encoded_program == 0) {
    state_->encoded_program = window_program(window_encoded_source);
    state_->dimmed_program = window_program(window_dimmed_source);
  }
}

void Presenter::resize(int width, int height, bool encoded) {
  if (state_->texture != 0 && state_->width == width && state_->height == height && state_->encoded == encoded) {
    return;
  }
  state_->encoded = encoded;
  state_->link.reset();
  glDeleteTextures(1, &state_->texture);
  glCreateTextures(GL_TEXTURE_2D, 1, &state_->texture);
  glTextureStorage2D(state_->texture, 1, encoded ? GL_RGBA8 : GL_RGBA32F, width, height);
  glTextureParameteri(state_->texture, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTextureParameteri(state_->texture, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTextureParameteri(state_->texture, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTextureParameteri(state_->texture, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  state_->width = width;
  state_->height = height;
}

void Presenter::upload(const Picture& picture) {
  resize(picture.width, picture.height, state_->encoded_program != 0);
  ++state_->version;
  state_->heat_map = picture.heat_range.has_value();
  state_->tone = picture.tone;
  state_->fill(picture, 0, 0);
}

void Presenter::upload_eyes(const Picture& left, const Picture& right, bool above) {
  const int left_px = above ? 0 : left.width;
  const int top_px = above ? left.height : 0;
  resize(left_px + right.width, top_px + right.height, state_->encoded_program != 0);
  ++state_->version;
  state_->heat_map = left.heat_range.has_value();
  state_->tone = left.tone;
  state_->fill(left, 0, 0);
  state_->fill(right, left_px, top_px);
}

void Presenter::upload_from_device(const DevicePicture& picture) {
  const int width = picture.width_px;
  const int height = picture.height_px;
  const int left_px = picture.right == nullptr || picture.above ? 0 : width;
  const int top_px = picture.right != nullptr && picture.above ? height : 0;
  resize(left_px + width, top_px + height, false);
  ++state_->version;
  state_->heat_map = picture.heat_map;
  state_->tone = picture.tone;
  if (!state_->link) {
    state_->link = std::make_unique<CudaTextureLink>(state_->texture);
  }
  const CudaTextureLink::Part parts[2] = {{picture.rgba, width, height, 0, 0},
                                          {picture.right, width, height, left_px, top_px}};
  state_->link->copy_from_device(std::span(parts).first(picture.right != nullptr ? 2 : 1));
}

void Presenter::set_light(float light) {
  if (light != state_->light) {
    state_->light = light;
    ++state_->version;
  }
}

void Presenter::lay_over(const LaidCaptions& captions, const EyeGrid& eyes) {
  state_->eyes = eyes;
  state_->captions.set(captions);
}

PresentedPicture Presenter::shown() const {
  return {state_->texture, state_->width, state_->height, state_->heat_map,
          state_->tone,    state_->light, state_->version};
}

PictureArea Presenter::area(int framebuffer_width, int framebuffer_height, PicturePart part) const {
  if (state_->texture == 0 || framebuffer_width <= 0 || framebuffer_height <= 0) {
    return {};
  }
  const double part_width = share_of(part) * state_->width;
  const double scale = std::min(static_cast<double>(framebuffer_width) / part_width,
                                static_cast<double>(framebuffer_height) / state_->height);
  const int width = std::max(1, static_cast<int>(std::lround(scale * part_width)));
  const int height = std::max(1, static_cast<int>(std::lround(scale * state_->height)));
  return {(framebuffer_width - width) / 2, (framebuffer_height - height) / 2, width, height};
}

void Presenter::draw(int framebuffer_width, int framebuffer_height, PicturePart part) {
  glViewport(0, 0, framebuffer_width, framebuffer_height);
  glClearColor(0.0F, 0.0F, 0.0F, 1.0F);
  glClear(GL_COLOR_BUFFER_BIT);
  const PictureArea shown = area(framebuffer_width, framebuffer_height, part);
  if (shown.width == 0) {
    return;
  }
  glViewport(shown.left, shown.bottom, shown.width, shown.height);
  glUseProgram(!state_->encoded       ? state_->program
               : state_->light < 1.0F ? state_->dimmed_program
                                      : state_->encoded_program);
  glUniform1i(0, state_->heat_map ? 1 : 0);
  set_tone(state_->tone);
  glUniform1f(4, state_->light);
  glUniform2f(3, part == PicturePart::right_half ? 0.5F : 0.0F, static_cast<float>(share_of(part)));
  glUniform1i(5, part == PicturePart::halves_by_rows ? framebuffer_height : 0);
  glBindTextureUnit(0, state_->texture);
  glBindVertexArray(state_->vertex_array);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  draw_captions(shown, part == PicturePart::whole ? state_->eyes : EyeGrid{});
}

void Presenter::draw_captions(const PictureArea& shown, const EyeGrid& eyes) {
  const CaptionTexture& captions = state_->captions;
  if (!captions.use(0)) {
    return;
  }
  const double rows_above = captions.first_row_part();
  const double rows_part = captions.row_part();
  glUseProgram(state_->captions_program);
  glUniform2f(0, captions.first_row_part(), captions.row_part());
  glUniform1f(1, captions.opacity());
  glUniform1f(2, state_->light);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glEnable(GL_SCISSOR_TEST);
  const int width = shown.width / eyes.columns;
  const int height = shown.height / eyes.rows;
  // Clips to the rows of an eye's picture that have captions, plus one row above and below for the
  // filter.
  const double bottom_part = 1.0 - rows_above - rows_part;
  const int from = static_cast<int>(std::floor(bottom_part * height)) - 1;
  const int rows = static_cast<int>(std::ceil(rows_part * height)) + 3;
  for (int eye = 0; eye < eyes.columns * eyes.rows; ++eye) {
    const int left = shown.left + eye % eyes.columns * width;
    const int bottom = shown.bottom + eye / eyes.columns * height;
    const int first = std::max(from, 0);
    glViewport(left, bottom, width, height);
    glScissor(left, bottom + first, width, std::min(from + rows, height) - first);
    glDrawArrays(GL_TRIANGLES, 0, 3);
  }
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_BLEND);
}

}  // namespace ergodome
