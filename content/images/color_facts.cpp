#include "content/images/color_facts.h"

#include <OpenImageIO/strutil.h>
#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "content/images/png_colors.h"

namespace ergodome {

namespace {

constexpr Chromaticities rec_709 = {0.64, 0.33, 0.30, 0.60, 0.15, 0.06, 0.3127, 0.3290};
constexpr Chromaticities rec_2020 = {0.708, 0.292, 0.170, 0.797, 0.131, 0.046, 0.3127, 0.3290};
constexpr Chromaticities display_p3 = {0.680, 0.320, 0.265, 0.690, 0.150, 0.060, 0.3127, 0.3290};
constexpr Chromaticities ntsc = {0.67, 0.33, 0.21, 0.71, 0.14, 0.08, 0.310, 0.316};
constexpr Chromaticities pal = {0.64, 0.33, 0.29, 0.60, 0.15, 0.06, 0.3127, 0.3290};
constexpr Chromaticities smpte_c = {0.630, 0.340, 0.310, 0.595, 0.155, 0.070, 0.3127, 0.3290};
constexpr Chromaticities dci_p3 = {0.680, 0.320, 0.265, 0.690, 0.150, 0.060, 0.314, 0.351};

//! Sets the primaries and curve of code points (ITU-T H.273, tables 2 and 3).
void take_code_points(const CodePoints& points, ColorFacts& facts) {
  switch (points.primaries) {
    case 1:
      facts.primaries = rec_709;
      break;
    case 4:
      facts.primaries = ntsc;
      break;
    case 5:
      facts.primaries = pal;
      break;
    case 6:
    case 7:
      facts.primaries = smpte_c;
      break;
    case 9:
      facts.primaries = rec_2020;
      break;
    case 11:
      facts.primaries = dci_p3;
      break;
    case 12:
      facts.primaries = display_p3;
      break;
    default:
      facts.problem = fmt::format("its cICP color primaries are number {}, which is not supported", points.primaries);
  }
  switch (points.transfer) {
    case 1:
    case 6:
    case 14:
    case 15:
      facts.curve = TransferCurve::bt709;
      break;
    case 4:
    case 5:
      facts.curve = TransferCurve::gamma;
      facts.gamma = points.transfer == 4 ? 2.2 : 2.8;
      break;
    case 8:
      facts.curve = TransferCurve::linear;
      break;
    case 13:
      facts.curve = TransferCurve::srgb;
      break;
    case 16:
      facts.curve = TransferCurve::pq;
      break;
    default:
      facts.problem = fmt::format("its cICP transfer function is {}, which is not supported",
                                  points.transfer == 18 ? "HLG" : fmt::format("number {}", points.transfer));
  }
  if (points.matrix != 0 || !points.full_range) {
    facts.problem = "its cICP describes YCbCr or a limited range, which is not supported";
  }
}

//! Sets the gamma of a file's numbers. An exponent close to 1 / 0.45455 stands for sRGB, as libpng takes it: many programs
//! describe sRGB by it.
void take_gamma(double exponent, ColorFacts& facts) {
  constexpr double srgb_exponent = 2.2;
  constexpr double significant = 0.05;
  if (std::abs(exponent / srgb_exponent - 1.0) <= significant) {
    facts.curve = TransferCurve::srgb;
  } else if (std::abs(exponent - 1.0) < 1e-4) {
    facts.curve = TransferCurve::linear;
  } else {
    facts.curve = TransferCurve::gamma;
    facts.gamma = exponent;
  }
}

std::vector<std::byte> icc_profile_of(const OIIO::ImageSpec& spec) {
  const OIIO::ParamValue* const profile = spec.find_attribute("ICCProfile");
  if (profile == nullptr || profile->type().basetype != OIIO::TypeDesc::UINT8) {
    return {};
  }
  const auto* const bytes = static_cast<const std::byte*>(profile->data());
  return {bytes, bytes + profile->type().size()};
}

void take_png(const NextBytes& png, ColorFacts& facts) {
  const PngColors colors = read_png_colors(png);
  if (colors.code_points) {
    facts.icc_profile.clear();
    take_code_points(*colors.code_points, facts);
  } else if (!facts.icc_profile.empty() || colors.is_srgb) {
    facts.curve = TransferCurve::srgb;
  } else {
    facts.primaries = colors.primaries;
    if (colors.gamma > 0.0) {
      take_gamma(1.0 / colors.gamma, facts);
    }
  }
}

//! Sets the curve of a color space's name in OpenImageIO.
void take_name(const OIIO::ImageSpec& spec, ColorFacts& facts) {
  const std::string name(spec.get_string_attribute("oiio:ColorSpace", "sRGB"));
  // Netpbm's files are Rec709 to OpenImageIO, by their specification; programs write sRGB into them.
  const bool is_srgb = name.empty() || OIIO::Strutil::iequals(name, "sRGB") || OIIO::Strutil::iequals(name, "Rec709");
  if (OIIO::Strutil::iequals(name, "linear")) {
    facts.curve = TransferCurve::linear;
  } else if (OIIO::Strutil::istarts_with(name, "GammaCorrected")) {
    take_gamma(static_cast<double>(spec.get_float_attribute("oiio:Gamma", 2.2F)), facts);
  } else if (!is_srgb) {
    facts.problem = fmt::format("its color space is {}, which is not supported", name);
  }
}

}  // namespace

ColorFacts color_facts(const OIIO::ImageInput& input, const NextBytes& png) {
  const OIIO::ImageSpec& spec = input.spec();
  const std::string_view format = input.format_name();
  ColorFacts facts;
  if (spec.format.is_floating_point()) {
    facts.curve = TransferCurve::linear;
  } else if (format != "png") {
    take_name(spec, facts);
  }
  if (format == "openexr") {
    const OIIO::ParamValue* const stored = spec.find_attribute("chromaticities");
    if (stored != nullptr && stored->type().basevalues() == 8 && stored->type().basetype == OIIO::TypeDesc::FLOAT) {
      facts.primaries.emplace();
      std::copy_n(static_cast<const float*>(stored->data()), 8, facts.primaries->begin());
    }
    return facts;
  }
  facts.icc_profile = icc_profile_of(spec);
  if (format == "png") {
    take_png(png, facts);
  }
  return facts;
}

}  // namespace ergodome
