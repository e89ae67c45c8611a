#pragma once

#include <vector>

#include "render/lens/omni_lens.h"
#include "render/passes/objects/polygons/connection_textures.h"

namespace ergodome {

//! Numbers that shaders have of an eye at a place beside a head, all in the head's rest frame (e_r, e_θ, e_φ): outwards from the hole x, y, z, the
//! eye's radius [M]; its velocity and a 0; and three rows, a 0 after each, that lead from that frame to the eye's own view.
inline constexpr int turning_groups = 5;

//! What shaders need of an eye that turns with the azimuth one looks at (kernels/trace/omni_camera.h).
struct TurningView {
  OmniCameraOf<float> eye;          //!< how it turns; its polynomials are not those here
  int degree;                       //!< of these
  std::vector<float> coefficients;  //!< term by term (render/lens/disk_fit.h), turning_groups of four numbers each
  RadialRange radii;                //!< that the eye has [M]
};

//! The same of an eye about a head, where `eye_at` says how eyes stand there. Throws Error where no polynomial is exact enough: the baseline is too
//! large for this place; and where an eye comes inside the photon sphere.
TurningView turning_view(const OmniEye& eye, const EyePlace& eye_at);

}  // namespace ergodome
