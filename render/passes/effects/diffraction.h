#pragma once

#include <filesystem>
#include <vector>

#include "kernels/core/vector3.h"
#include "render/passes/effects/far_field.h"

namespace ergodome {

//! The light of a point behind an aperture: what a pupil makes of a star. Its middle is the middle of the square.
struct DiffractionPattern {
  int size_px = 0;         //!< width and height; odd
  std::vector<float> rgb;  //!< three floats a pixel, linear sRGB, the top row first; each channel adds up to 1
};

//! The Fraunhofer pattern of an aperture in white light (equal energy at 400 to 700 nm, made white in the display's primaries).
//!
//! Light that falls outside of the square is left out, and so is the part of a colour beyond what the display can show. Takes a
//! transform of up to 4096² points: to be done once. Throws Error for settings out of range.
DiffractionPattern diffraction_pattern(const ApertureSettings& settings);

//! Reads a pattern from an image through OpenImageIO, its middle where the image's is; grey becomes colour, alpha is ignored.
//!
//! Whole numbers are decoded from sRGB, unless the file says that they are linear; negative light counts as 0. Each channel is
//! normalised to 1; an image that is not a square or even is padded with black to an odd square. Throws Error for what cannot be read,
//! is larger than 1025 px, not finite, or black in a channel.
DiffractionPattern load_diffraction_pattern(const std::filesystem::path& path);

//! Rows of a picture in host memory, four floats a pixel, linear light, of which some columns are drawn to.
struct PixelBlock {
  int width;         //!< pixels in a row
  int height;        //!< rows; none where it is not above 0
  int first_column;  //!< drawn to, up to before `end_column`
  int end_column;
  float* rgba;  //!< the first row
};

//! Adds the pattern of a point of light to a block of pixels; coverage stays.
//!
//! (x_px, y_px) is the point's place, (0.5, 0.5) the middle of the block's first pixel; the pattern is placed bilinearly between pixels. The
//! light added is `light` [picture value times pixels], less what falls beside the block. A place that is not finite adds nothing.
void add_diffraction(const DiffractionPattern& pattern, double x_px, double y_px, const Vector3<float>& light,
                     const PixelBlock& block);

//! The same for the whole of a picture's rows.
inline void add_diffraction(const DiffractionPattern& pattern, double x_px, double y_px, const Vector3<float>& light,
                            int width, int height, float* rgba) {
  add_diffraction(pattern, x_px, y_px, light, {width, height, 0, width, rgba});
}

}  // namespace ergodome
