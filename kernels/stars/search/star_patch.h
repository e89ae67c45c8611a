#pragma once

#include "kernels/core/host_device.h"
#include "kernels/core/vector3.h"
#include "kernels/stars/search/bezier_patch.h"

// Patches of a lens grid in which images of stars are sought, and the parts of the sky that they
// cover.
namespace ergodome {

//! Orthonormal axes of the sky, aligned with a patch.
struct PatchFrame {
  Vector3<double> first;   //!< along the patch's long side
  Vector3<double> second;  //!< along the patch's narrow side
  Vector3<double> axis;    //!< direction to the patch's middle
};

//! Range of heights and azimuths of a part of the sky.
struct SkyBounds {
  float low;          //!< minimum height z
  float high;         //!< maximum height z
  float turns;        //!< where the range of azimuths begins [turns], in [0, 1)
  float width_turns;  //!< width of the range of azimuths [turns]; 1 about a pole
};

//! A part of the sky in which stars are sought: the inside of four planes through the sky's center,
//! with its bounds.
struct SkyPart {
  float inward[4][3];  //!< inward normals of the four planes
  SkyBounds bounds;
};

//! A rotation by φ about z.
struct SkyRotation {
  float turns;  //!< angle φ [turns], in [0, 1)
  double sine;
  double cosine;
};

//! Brightness threshold for stars: a star is above it if its illuminance, multiplied by the gain of
//! its class in row `shift_row` of SearchedField::gains, is at least `illuminance` [lx], which is
//! not negative.
struct StarFloor {
  float illuminance;
  int shift_row;
};

//! Upper limit of the brightening of stars for an observer: `brighter`, times the magnification in
//! the rain frame, times the gain of the star's class in row `shift_row` of SearchedField::gains.
struct PatchLight {
  float brighter;
  int shift_row;
};

//! A part of a lens grid over which the lens is simple enough to be inverted.
struct StarPatch {
  BezierPatch sky;  //!< direction on the sky as a function of (u, v), in the patch's own frame
  PatchFrame frame;
  SkyPart part;  //!< part of the sky that encloses the patch
  //! Lower corner (gamma_turns, s) of the patch's rectangle in the chart; the rectangle's size is
  //! (width_turns, height).
  float gamma_turns;
  float s;
  float width_turns;
  float height;
  PatchShape shape;
  int leaf;        //!< leaf of the grid that contains the patch
  float brighter;  //!< factor by which an image in the patch may be brighter than the grid indicates
  bool exact;      //!< images in the patch need no rays after their correction, unless the patch is folded
  //! Distance by which the patch may deviate from the true sky [rad]. It only matters next to
  //! critical curves, and is 0 if the patch cannot contain one.
  float error;
  int halvings;  //!< maximum number of halvings when the patch is searched, if it is not regular
  PatchLight light;
  Vector3<float> seen;  //!< direction to the patch in the observer's frame
  float seen_radius;    //!< half angle of a cone about that direction that encloses the patch [rad]
  //! Maximum solid angle of the rain frame's camera per unit area of the patch's (u, v) [sr].
  float max_camera;
  //! Maximum magnification of images in the rain frame. In a folded patch, it is exceeded only for
  //! stars on 1e-8 sr of the sky.
  float magnification;
};

inline namespace ERGO_TARGET {

//! Returns the part after mirroring it at the equator, if `mirrored`, and then rotating it.
ERGO_HD SkyPart turned(const SkyPart& part, const SkyRotation& turn, bool mirrored) {
  const auto sine = static_cast<float>(turn.sine);
  const auto cosine = static_cast<float>(turn.cosine);
  SkyPart other;
  for (int side = 0; side < 4; ++side) {
    const float(&n)[3] = part.inward[side];
    other.inward[side][0] = cosine * n[0] - sine * n[1];
    other.inward[side][1] = sine * n[0] + cosine * n[1];
    other.inward[side][2] = mirrored ? -n[2] : n[2];
  }
  const SkyBounds& bounds = part.bounds;
  const float turns = bounds.turns + turn.turns;
  other.bounds = {mirrored ? -bounds.high : bounds.low, mirrored ? -bounds.low : bounds.high,
                  turns < 1.0F ? turns : turns - 1.0F, bounds.width_turns};
  return other;
}

//! Rotates a star's direction to the frame of the patches, which belong to a camera at φ = 0, and
//! mirrors it if they cover the other half of a mirrored sky.
ERGO_HD Vector3<double> as_patches_see(const SkyRotation& turn, const Vector3<double>& d, bool mirrored) {
  return {turn.cosine * d.x + turn.sine * d.y, turn.cosine * d.y - turn.sine * d.x, mirrored ? -d.z : d.z};
}

//! Returns the threshold of stars that may have images of at least `faintest` lx in a patch.
ERGO_HD StarFloor floor_of(const StarPatch& patch, float faintest) {
  return {faintest / (patch.light.brighter * patch.magnification), patch.light.shift_row};
}

}  // namespace ERGO_TARGET
}  // namespace ergodome
