#pragma once

#include <string>
#include <vector>

#include "render/output/tone.h"

// What shaders of the project share.
namespace ergodome {

//! A vertex shader for one triangle (three vertices, no attributes) that covers the viewport; `place` runs from 0 to 1, upwards.
extern const char* const whole_viewport_source;

//! The head of a fragment shader (with its version line) that has `vec3 toned(vec3 light)`, what render/output/tone.h computes. It takes
//! the uniforms' locations 1 and 2, which set_tone sets.
extern const char* const tone_source;

//! A shader's kind, as OpenGL counts them (GL_VERTEX_SHADER and so on), and its text.
struct ShaderSource {
  unsigned kind;
  std::string text;
};

//! A program of any shaders, in the current context. Throws Error, with what the driver says, when it refuses them.
unsigned linked_program(const std::vector<ShaderSource>& shaders);

//! A program of two shaders, in the current context. Throws Error, with what the driver says, when it refuses them.
unsigned linked_program(const std::string& vertex_source, const std::string& fragment_source);

//! Sets the tone of the program in use, which has tone_source in it.
void set_tone(const Tone& tone);

//! Whether the current context is drawn by the processor, for lack of a GPU: Mesa's llvmpipe or softpipe.
bool draws_in_software();

//! Throws Error unless the current context is OpenGL 4.5.
void require_gl_45();

}  // namespace ergodome
