#include "render/present/presenter.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "kernels/core/error.h"
#include "render/present/cuda_interop.h"

namespace ergodome {

struct Presenter::State {
  GLuint program = 0;
  GLuint vertex_array = 0;
  GLuint texture = 0;
  int width = 0;
  int height = 0;
  bool heat_map = false;
  Tone tone;
  std::unique_ptr<CudaTextureLink> link;
};

namespace {

constexpr const char* vertex_source = R"(#version 450 core
out vec2 place;
void main() {
  // One triangle that covers the viewport.
  place = vec2(float((gl_VertexID << 1) & 2), float(gl_VertexID & 2));
  gl_Position = vec4(place * 2.0 - 1.0, 0.0, 1.0);
}
)";

constexpr const char* fragment_source = R"(#version 450 core
in vec2 place;
out vec4 colour;
layout(binding = 0) uniform sampler2D picture;
layout(location = 0) uniform bool heat_map;
layout(location = 1) uniform int curve;
layout(location = 2) uniform vec3 tone;  // gain, white, gamma
vec3 toned(vec3 light) {
  vec3 x = tone.x * light;
  if (curve == 1) {
    return x * (1.0 + x / (tone.y * tone.y)) / (1.0 + x);
  }
  if (curve == 2) {
    x = min(x, 1e4);
    return x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14);
  }
  if (curve == 3) {
    return pow(x, vec3(1.0 / tone.z));
  }
  const float knee = 0.8;
  return mix(x, 1.0 - (1.0 - knee) * exp(-(x - knee) / (1.0 - knee)), greaterThan(x, vec3(knee)));
}
vec3 encoded(vec3 light) {
  return mix(12.92 * light, 1.055 * pow(light, vec3(1.0 / 2.4)) - 0.055, greaterThan(light, vec3(0.0031308)));
}
void main() {
  // The picture's first row is its top.
  vec3 light = max(texture(picture, vec2(place.x, 1.0 - place.y)).rgb, vec3(0.0));
  colour = vec4(encoded(clamp(heat_map ? light : toned(light), 0.0, 1.0)), 1.0);
}
)";

GLuint compiled(GLenum kind, const char* source) {
  const GLuint shader = glCreateShader(kind);
  glShaderSource(shader, 1, &source, nullptr);
  glCompileShader(shader);
  GLint good = GL_FALSE;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
  if (good == GL_FALSE) {
    char log[1024] = {};
    glGetShaderInfoLog(shader, sizeof log, nullptr, log);
    throw Error("OpenGL", std::string("the driver refuses a shader: ") + log, "update the graphics driver");
  }
  return shader;
}

GLuint linked_program() {
  const GLuint vertex = compiled(GL_VERTEX_SHADER, vertex_source);
  const GLuint fragment = compiled(GL_FRAGMENT_SHADER, fragment_source);
  const GLuint program = glCreateProgram();
  glAttachShader(program, vertex);
  glAttachShader(program, fragment);
  glLinkProgram(program);
  glDeleteShader(vertex);
  glDeleteShader(fragment);
  GLint good = GL_FALSE;
  glGetProgramiv(program, GL_LINK_STATUS, &good);
  if (good == GL_FALSE) {
    throw Error("OpenGL", "the driver cannot link the shaders", "update the graphics driver");
  }
  return program;
}

}  // namespace

Presenter::Presenter() : state_(std::make_unique<State>()) {
  if (epoxy_gl_version() < 45) {
    throw Error("OpenGL", "the driver has no OpenGL 4.5", "update the graphics driver");
  }
  state_->program = linked_program();
  glCreateVertexArrays(1, &state_->vertex_array);
}

Presenter::~Presenter() {
  state_->link.reset();
  glDeleteTextures(1, &state_->texture);
  glDeleteVertexArrays(1, &state_->vertex_array);
  glDeleteProgram(state_->program);
}

void Presenter::resize(int width, int height) {
  if (state_->texture != 0 && state_->width == width && state_->height == height) {
    return;
  }
  state_->link.reset();
  glDeleteTextures(1, &state_->texture);
  glCreateTextures(GL_TEXTURE_2D, 1, &state_->texture);
  glTextureStorage2D(state_->texture, 1, GL_RGBA32F, width, height);
  glTextureParameteri(state_->texture, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTextureParameteri(state_->texture, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTextureParameteri(state_->texture, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTextureParameteri(state_->texture, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  state_->width = width;
  state_->height = height;
}

void Presenter::upload(const Picture& picture) {
  resize(picture.width, picture.height);
  state_->heat_map = picture.heat_range.has_value();
  state_->tone = picture.tone;
  glTextureSubImage2D(state_->texture, 0, 0, 0, picture.width, picture.height, GL_RGBA, GL_FLOAT, picture.rgba.data());
}

void Presenter::upload_from_device(const float* rgba, int width, int height, bool heat_map, const Tone& tone) {
  resize(width, height);
  state_->heat_map = heat_map;
  state_->tone = tone;
  if (!state_->link) {
    state_->link = std::make_unique<CudaTextureLink>(state_->texture, width, height);
  }
  state_->link->copy_from_device(rgba);
}

void Presenter::draw(int framebuffer_width, int framebuffer_height) {
  glViewport(0, 0, framebuffer_width, framebuffer_height);
  glClearColor(0.0F, 0.0F, 0.0F, 1.0F);
  glClear(GL_COLOR_BUFFER_BIT);
  if (state_->texture == 0 || framebuffer_width <= 0 || framebuffer_height <= 0) {
    return;
  }
  const double scale = std::min(static_cast<double>(framebuffer_width) / state_->width,
                                static_cast<double>(framebuffer_height) / state_->height);
  const int width = std::max(1, static_cast<int>(std::lround(scale * state_->width)));
  const int height = std::max(1, static_cast<int>(std::lround(scale * state_->height)));
  glViewport((framebuffer_width - width) / 2, (framebuffer_height - height) / 2, width, height);
  glUseProgram(state_->program);
  glUniform1i(0, state_->heat_map ? 1 : 0);
  glUniform1i(1, static_cast<int>(state_->tone.curve));
  glUniform3f(2, state_->tone.gain, state_->tone.white, state_->tone.gamma);
  glBindTextureUnit(0, state_->texture);
  glBindVertexArray(state_->vertex_array);
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

std::vector<std::uint8_t> Presenter::read_back(int width, int height) {
  const std::size_t row = 3 * static_cast<std::size_t>(width);
  std::vector<std::uint8_t> bottom_up(row * static_cast<std::size_t>(height));
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, bottom_up.data());
  std::vector<std::uint8_t> top_down(bottom_up.size());
  for (std::size_t y = 0; y < static_cast<std::size_t>(height); ++y) {
    std::copy_n(bottom_up.begin() + static_cast<long>(y * row), row,
                top_down.begin() + static_cast<long>((static_cast<std::size_t>(height) - 1 - y) * row));
  }
  return top_down;
}

}  // namespace ergodome
