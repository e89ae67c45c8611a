#pragma once

#include "kernels/core/vector3.h"
#include "kernels/sky/cube_map.h"

namespace ergodome {

//! How a shell looks.
struct ShellAppearance {
  float r;           //!< radius of the shell [M]
  float spacing;     //!< spacing of the grid lines, as an angle at the shell's center [rad]
  float line_width;  //!< width of the grid lines, as an angle at the shell's center [rad]
  float line_opacity;
  float fill_opacity;
  bool textured;
  Vector3<float> line;  //!< linear light
  Vector3<float> fill;  //!< linear light between the lines; multiplies the texture if there is one
  CubeMap texture;
};

//! Shells as kernels read them, the outermost first.
struct ShellTable {
  const float* u;  //!< 1/r of each shell [1/M]
  const ShellAppearance* appearances;
  int count;     //!< number of shells; 0: none
  bool shifted;  //!< light is multiplied by g⁴
};

}  // namespace ergodome
