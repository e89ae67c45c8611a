#pragma once

#include <OpenImageIO/imageio.h>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "content/images/formats/png_chunks.h"

namespace ergodome {

//! The transfer function from a file's numbers to linear light, the same for each channel.
enum class TransferCurve { linear, srgb, gamma, bt709, pq };

//! The xy chromaticities of red, green, blue and white.
using Chromaticities = std::array<double, 8>;

//! The chromaticities of Rec. 709, which sRGB shares (ITU-R BT.709-6).
inline constexpr Chromaticities rec_709 = {0.64, 0.33, 0.30, 0.60, 0.15, 0.06, 0.3127, 0.3290};

//! Color metadata of a file. Without a profile and primaries, the primaries are those of Rec. 709.
struct ColorMetadata {
  std::vector<std::byte> icc_profile;  //!< empty if there is none; a profile describes the colors completely
  std::optional<Chromaticities> primaries;
  bool adapts_xyz = false;  //!< the primaries are CIE X, Y and Z; their white (1, 1, 1) is shown as white
  TransferCurve curve = TransferCurve::srgb;
  double gamma = 1.0;   //!< exponent of TransferCurve::gamma
  std::string problem;  //!< what is not supported; empty if everything is
};

//! Reads the color metadata of an opened file. In a PNG, cICP overrides iCCP, which overrides sRGB,
//! which overrides gAMA and cHRM (PNG, third edition, 4.3); `png` yields the file's bytes from the
//! first on. Does not read the PRIMARIES of Radiance files; read_radiance_header() does.
ColorMetadata color_metadata(const OIIO::ImageInput& input, const NextBytes& png);

}  // namespace ergodome
