#include "render/opengl/gl_program.h"

#include <epoxy/gl.h>

#include "kernels/core/error.h"

namespace ergodome {

const char* const whole_viewport_source = R"(#version 450 core
out vec2 place;
void main() {
  // One triangle that covers the viewport.
  place = vec2(float((gl_VertexID << 1) & 2), float(gl_VertexID & 2));
  gl_Position = vec4(place * 2.0 - 1.0, 0.0, 1.0);
}
)";

const char* const tone_source = R"(#version 450 core
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
)";

const char* const encoding_source = R"(
vec3 encoded(vec3 light) {
  return mix(12.92 * light, 1.055 * pow(light, vec3(1.0 / 2.4)) - 0.055, greaterThan(light, vec3(0.0031308)));
}
)";

namespace {

GLuint compiled(GLenum kind, const std::string& source) {
  const GLuint shader = glCreateShader(kind);
  const char* const text = source.c_str();
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  GLint good = GL_FALSE;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
  if (good == GL_FALSE) {
    char log[1024] = {};
    glGetShaderInfoLog(shader, sizeof log, nullptr, log);
    glDeleteShader(shader);
    throw Error("OpenGL", std::string("the graphics driver cannot compile a shader: ") + log,
                "update the graphics driver");
  }
  return shader;
}

}  // namespace

unsigned linked_program(const std::vector<ShaderSource>& shaders) {
  const GLuint program = glCreateProgram();
  try {
    for (const ShaderSource& source : shaders) {
      const GLuint shader = compiled(source.kind, source.text);
      glAttachShader(program, shader);
      glDeleteShader(shader);
    }
  } catch (const Error&) {
    glDeleteProgram(program);
    throw;
  }
  glLinkProgram(program);
  GLint good = GL_FALSE;
  glGetProgramiv(program, GL_LINK_STATUS, &good);
  if (good == GL_FALSE) {
    glDeleteProgram(program);
    throw Error("OpenGL", "the graphics driver cannot link the shaders", "update the graphics driver");
  }
  return program;
}

unsigned linked_program(const std::string& vertex_source, const std::string& fragment_source) {
  return linked_program({{GL_VERTEX_SHADER, vertex_source}, {GL_FRAGMENT_SHADER, fragment_source}});
}

void set_tone(const Tone& tone) {
  glUniform1i(1, static_cast<int>(tone.curve));
  glUniform3f(2, tone.gain, tone.white, tone.gamma);
}

bool draws_in_software() {
  const auto* const name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  const std::string renderer = name != nullptr ? name : "";
  return renderer.find("llvmpipe") != std::string::npos || renderer.find("softpipe") != std::string::npos;
}

void require_gl_45() {
  if (epoxy_gl_version() < 45) {
    throw Error("OpenGL", "the graphics driver does not support OpenGL 4.5", "update the graphics driver");
  }
}

}  // namespace ergodome
