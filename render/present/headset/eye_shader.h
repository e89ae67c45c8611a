#pragma once

namespace ergodome {

//! Fragment shader of EyePainter, to follow tone_source and encoding_source: the lensed sky in the
//! direction of each pixel, under the vignette, the rest frame and the panels.
extern const char* const eye_shader_source;

}  // namespace ergodome
