#pragma once

#include "kernels/core/vector3.h"
#include "kernels/sky/cube_map.h"

namespace ergodome {

//! How a shell looks.
struct ShellLook {
  float r;           //!< [M]
  float spacing;     //!< of the grid [rad]
  float line_width;  //!< [rad]
  float line_opacity;
  float fill_opacity;
  bool textured;
  Vector3<float> line;  //!< linear light
  Vector3<float> fill;  //!< linear light; with a texture, a factor on it
  CubeMap texture;
};

//! Shells as kernels read them, the outermost first.
struct ShellTable {
  const float* u;  //!< 1/r of each [1/M]
  const ShellLook* looks;
  int count;     //!< 0: no shells
  bool shifted;  //!< light is multiplied by g⁴
};

}  // namespace ergodome
