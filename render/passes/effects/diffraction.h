#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "content/show/show.h"
#include "kernels/core/vector3.h"
#include "kernels/image/shade_pixels.h"
#include "render/passes/effects/far_field.h"

namespace ergodome {

//! Returns whether the stars of a show have spikes.
inline bool shows_spikes(const Show& show, ViewMode mode) {
  const std::optional<DiffractionSettings>& diffraction = show.effects.diffraction;
  return mode == ViewMode::sky && !show.sky.stars.empty() && diffraction && diffraction->strength > 0.0;
}

//! Diffraction pattern of a point of light behind an aperture. The center of the pattern is the
//! center of its square.
struct DiffractionPattern {
  int size_px = 0;         //!< width and height; odd
  std::vector<float> rgb;  //!< three floats per pixel, linear sRGB, top row first; each channel adds up to 1
};

//! Computes the Fraunhofer pattern of an aperture in white light (equal energy from 400 to 700 nm,
//! balanced to the display's white).
//!
//! Omits light outside of the square, and clips colors outside the display's gamut. Takes a Fourier
//! transform of up to 4096² points, so compute it once. Throws Error for settings out of range.
DiffractionPattern diffraction_pattern(const ApertureSettings& settings);

//! Reads a pattern from an image with OpenImageIO; its center is that of the image. Gray is
//! converted to RGB; alpha is ignored.
//!
//! Integers are decoded from sRGB unless the file declares them linear; negative light counts as 0.
//! Normalizes each channel to 1. Pads images that are not square or have an even size with black to
//! an odd square. Throws Error if the image is unreadable, larger than 1025 px, non-finite, or
//! black in a channel.
DiffractionPattern load_diffraction_pattern(const std::filesystem::path& path);

//! A block of rows of a picture in host memory, four floats per pixel, linear light. Only a range
//! of its columns is drawn.
struct PixelBlock {
  int width;         //!< pixels per row
  int height;        //!< number of rows; nothing is drawn if it is not positive
  int first_column;  //!< columns [first_column, end_column) are drawn
  int end_column;
  float* rgba;  //!< pixels of the first row
};

//! Adds the pattern of a point of light to a block of pixels. Coverage does not change.
//! (x_px, y_px) is the point's position; (0.5, 0.5) is the center of the block's first pixel. The
//! pattern is positioned bilinearly at subpixel accuracy. It adds a total of `light` [picture value
//! times pixels], less what falls outside the block. Non-finite positions add nothing.
void add_diffraction(const DiffractionPattern& pattern, double x_px, double y_px, const Vector3<float>& light,
                     const PixelBlock& block);

//! Adds the pattern to entire rows of a picture.
inline void add_diffraction(const DiffractionPattern& pattern, double x_px, double y_px, const Vector3<float>& light,
                            int width, int height, float* rgba) {
  add_diffraction(pattern, x_px, y_px, light, {width, height, 0, width, rgba});
}

}  // namespace ergodome
