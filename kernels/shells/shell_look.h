#pragma once

#include "kernels/core/vector3.h"
#include "kernels/sky/cube_map.h"

namespace ergodome {

//! What a shell looks like.
struct ShellLook {
  float r;           //!< [M]
  float spacing;     //!< of the grid [rad]
  float line_width;  //!< [rad]
  float line_opacity;
  float fill_opacity;
  bool textured;
  Vector3<float> line;  //!< linear light
  Vector3<float> fill;  //!< the same; of a texture, a factor
  CubeMap texture;
};

//! Shells as kernels read them, the outermost first.
struct ShellTable {
  const float* u;  //!< 1/r of each [1/M]
  const ShellLook* looks;
  int count;     //!< 0: none
  bool shifted;  //!< light goes with g⁴
};

}  // namespace ergodome
