#pragma once

#include "kernels/stars/search/bezier_patch.h"
#include "kernels/stars/search/sky_part.h"

namespace ergodome {

//! What light becomes for an observer, at the most: stars are so much brighter, times their magnification in the rain frame and what their
//! class gains in that row of ShiftGains.
struct PatchLight {
  float brighter;
  int shift_row;
};

//! A part of a lens grid over which the lens is simple enough to be inverted.
struct StarPatch {
  BezierPatch sky;  //!< in its frame
  PatchFrame frame;
  SkyPart part;       //!< holds all of it on the sky
  float gamma_turns;  //!< its place in the chart
  float s;
  float width_turns;
  float height;
  PatchShape shape;
  int leaf;        //!< whose part it is
  float brighter;  //!< what an image in it may be brighter by than the grid makes it out to be, as a factor
  bool exact;      //!< images in it, mended, need no rays, where it is not folded
  float error;     //!< how far it may be from the sky where that matters, next to critical curves [rad]
  int halvings;    //!< that its search for images takes, where it is not regular
  PatchLight light;
  Vector3<float> seen;  //!< the way to it in the observer's frame
  float seen_radius;    //!< of a cone about that way that holds it [rad]
  float most_camera;    //!< most that the rain frame's camera sees of it per unit of its own (u, v) [sr]
  float magnification;  //!< the most in it, in the rain frame; where folded, but for 1e-8 sr of the sky
};

}  // namespace ergodome
