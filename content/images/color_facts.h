#pragma once

#include <OpenImageIO/imageio.h>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "content/images/png_chunks.h"

namespace ergodome {

//! How a file's numbers become linear light, each color by itself.
enum class TransferCurve { linear, srgb, gamma, bt709, pq };

//! The xy chromaticities of red, green, blue and white.
using Chromaticities = std::array<double, 8>;

//! What a file says about its colors. Without a profile or primaries they are those of Rec. 709.
struct ColorFacts {
  std::vector<std::byte> icc_profile;  //!< empty if none; it describes the colors completely
  std::optional<Chromaticities> primaries;
  TransferCurve curve = TransferCurve::srgb;
  double gamma = 1.0;   //!< exponent of TransferCurve::gamma
  std::string problem;  //!< what is not supported; empty if nothing
};

//! Collects what an opened file says about its colors. In PNG, cICP overrides iCCP, which overrides sRGB, which overrides gAMA
//! and cHRM (PNG, third edition, 4.3); `png` yields the file's bytes from the first on. Radiance's PRIMARIES are read elsewhere.
ColorFacts color_facts(const OIIO::ImageInput& input, const NextBytes& png);

}  // namespace ergodome
