#pragma once

#include <string>
#include <vector>

#include "kernels/image/tone_curve.h"

// Code that the project's shaders share.
namespace ergodome {

//! Vertex shader for one triangle (three vertices, no attributes) that covers the viewport. Its
//! output `place` runs from 0 to 1, upwards.
extern const char* const whole_viewport_source;

//! Beginning of a fragment shader, including its version line. Defines `vec3 toned(vec3 light)`,
//! which computes the same as kernels/image/tone_curve.h. Uses the uniform locations 1 and 2, which
//! set_tone sets.
extern const char* const tone_source;

//! Part of a shader: `vec3 encoded(vec3 light)`, which encodes display light as sRGB values.
extern const char* const encoding_source;

//! A shader's kind, as an OpenGL constant (GL_VERTEX_SHADER and so on), and its source.
struct ShaderSource {
  unsigned kind;
  std::string text;
};

//! Compiles and links a program of any shaders in the current context. Throws Error if the driver
//! rejects them, with its message if a shader does not compile.
unsigned linked_program(const std::vector<ShaderSource>& shaders);

//! Compiles and links a program of a vertex shader and a fragment shader in the current context.
//! Throws Error like the overload above.
unsigned linked_program(const std::string& vertex_source, const std::string& fragment_source);

//! Sets the uniforms for the tone in the current program, which must contain tone_source.
void set_tone(const Tone& tone);

//! Returns whether the current context renders on the CPU: Mesa's llvmpipe or softpipe.
bool draws_in_software();

//! Throws Error unless the current context is OpenGL 4.5 or later.
void require_gl_45();

}  // namespace ergodome
