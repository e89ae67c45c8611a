#pragma once

#include <vector>

#include "render/lens/omni_lens.h"
#include "render/passes/objects/polygons/connection_textures.h"

namespace ergodome {

//! Number of vec4 groups that describe an eye beside a head to shaders, in the head's rest frame
//! (e_r, e_θ, e_φ): outward unit vector from the hole, and the eye's radius [M]; its velocity and a
//! 0; and three rows, each followed by a 0, of the matrix from that frame to the eye's view.
inline constexpr int omni_groups = 5;

//! Parameters for shaders of an omnidirectional stereo eye (kernels/spacetime/trace/omni_camera.h).
struct OmniView {
  //! Offset, convergence and fade of the eye; its polynomials are not used.
  OmniCameraOf<float> eye;
  //! Degree in the eye's position of the polynomials of `coefficients`.
  int degree;
  std::vector<float> coefficients;  //!< omni_groups of four per term (render/eyes/disk_fit.h)
  RadialRange radii;                //!< range of the radii that the eye reaches as it turns [M]
};

//! Computes the parameters of an eye around a head; `eye_at` returns the eye at an offset. Throws
//! Error if no polynomial is accurate enough, because the baseline is too large for this position,
//! or if an eye is inside the photon sphere.
OmniView omni_view(const OmniEye& eye, const EyeAtOffset& eye_at);

}  // namespace ergodome
