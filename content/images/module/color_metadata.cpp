#include "content/images/module/color_metadata.h"

#include <OpenImageIO/strutil.h>
#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "content/images/formats/png_chunks.h"

namespace ergodome {

namespace {

constexpr Chromaticities rec_2020 = {0.708, 0.292, 0.170, 0.797, 0.131, 0.046, 0.3127, 0.3290};
constexpr Chromaticities display_p3 = {0.680, 0.320, 0.265, 0.690, 0.150, 0.060, 0.3127, 0.3290};
constexpr Chromaticities ntsc = {0.67, 0.33, 0.21, 0.71, 0.14, 0.08, 0.310, 0.316};
constexpr Chromaticities pal = {0.64, 0.33, 0.29, 0.60, 0.15, 0.06, 0.3127, 0.3290};
constexpr Chromaticities smpte_c = {0.630, 0.340, 0.310, 0.595, 0.155, 0.070, 0.3127, 0.3290};
constexpr Chromaticities dci_p3 = {0.680, 0.320, 0.265, 0.690, 0.150, 0.060, 0.314, 0.351};

//! Sets primaries and transfer function from code points (ITU-T H.273, tables 2 and 3).
void take_code_points(const CodePoints& points, ColorMetadata& metadata) {
  switch (points.primaries) {
    case 1:
      metadata.primaries = rec_709;
      break;
    case 4:
      metadata.primaries = ntsc;
      break;
    case 5:
      metadata.primaries = pal;
      break;
    case 6:
    case 7:
      metadata.primaries = smpte_c;
      break;
    case 9:
      metadata.primaries = rec_2020;
      break;
    case 11:
      metadata.primaries = dci_p3;
      break;
    case 12:
      metadata.primaries = display_p3;
      break;
    default:
      metadata.problem =
          fmt::format("its cICP color primaries are number {}, which is not supported", points.primaries);
  }
  switch (points.transfer) {
    case 1:
    case 6:
    case 14:
    case 15:
      metadata.curve = TransferCurve::bt709;
      break;
    case 4:
    case 5:
      metadata.curve = TransferCurve::gamma;
      metadata.gamma = points.transfer == 4 ? 2.2 : 2.8;
      break;
    case 8:
      metadata.curve = TransferCurve::linear;
      break;
    case 13:
      metadata.curve = TransferCurve::srgb;
      break;
    case 16:
      metadata.curve = TransferCurve::pq;
      break;
    default:
      metadata.problem = fmt::format("its cICP transfer function is {}, which is not supported",
                                     points.transfer == 18 ? "HLG" : fmt::format("number {}", points.transfer));
  }
  if (points.matrix != 0 || !points.full_range) {
    metadata.problem = "its cICP describes YCbCr or a limited range, which is not supported";
  }
}

//! Sets the transfer function from an exponent. An exponent close to 2.2 is taken as the sRGB
//! curve, as in libpng, because many programs write 2.2 for sRGB.
void take_gamma(double exponent, ColorMetadata& metadata) {
  constexpr double srgb_exponent = 2.2;
  constexpr double significant = 0.05;
  if (std::abs(exponent / srgb_exponent - 1.0) <= significant) {
    metadata.curve = TransferCurve::srgb;
  } else if (std::abs(exponent - 1.0) < 1e-4) {
    metadata.curve = TransferCurve::linear;
  } else {
    metadata.curve = TransferCurve::gamma;
    metadata.gamma = exponent;
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

void take_png(const NextBytes& png, ColorMetadata& metadata) {
  const PngColors colors = read_png_colors(png);
  if (colors.code_points) {
    metadata.icc_profile.clear();
    take_code_points(*colors.code_points, metadata);
  } else if (!metadata.icc_profile.empty() || colors.is_srgb) {
    metadata.curve = TransferCurve::srgb;
  } else {
    metadata.primaries = colors.primaries;
    if (colors.gamma > 0.0) {
      take_gamma(1.0 / colors.gamma, metadata);
    }
  }
}

//! Sets the transfer function from OpenImageIO's name of the color space.
void take_name(const OIIO::ImageSpec& spec, ColorMetadata& metadata) {
  const std::string name(spec.get_string_attribute("oiio:ColorSpace", "sRGB"));
  // OpenImageIO reports Rec709 for Netpbm files, following their specification, but programs write
  // sRGB into them.
  const bool is_srgb = name.empty() || OIIO::Strutil::iequals(name, "sRGB") || OIIO::Strutil::iequals(name, "Rec709");
  if (OIIO::Strutil::iequals(name, "linear")) {
    metadata.curve = TransferCurve::linear;
  } else if (OIIO::Strutil::istarts_with(name, "GammaCorrected")) {
    take_gamma(static_cast<double>(spec.get_float_attribute("oiio:Gamma", 2.2F)), metadata);
  } else if (!is_srgb) {
    metadata.problem = fmt::format("its color space is {}, which is not supported", name);
  }
}

}  // namespace

ColorMetadata color_metadata(const OIIO::ImageInput& input, const NextBytes& png) {
  const OIIO::ImageSpec& spec = input.spec();
  const std::string_view format = input.format_name();
  ColorMetadata metadata;
  if (spec.format.is_floating_point()) {
    metadata.curve = TransferCurve::linear;
  } else if (format != "png") {
    take_name(spec, metadata);
  }
  if (format == "openexr") {
    const OIIO::ParamValue* const stored = spec.find_attribute("chromaticities");
    if (stored != nullptr && stored->type().basevalues() == 8 && stored->type().basetype == OIIO::TypeDesc::FLOAT) {
      metadata.primaries.emplace();
      std::copy_n(static_cast<const float*>(stored->data()), 8, metadata.primaries->begin());
    }
    return metadata;
  }
  metadata.icc_profile = icc_profile_of(spec);
  if (format == "png") {
    take_png(png, metadata);
  }
  return metadata;
}

}  // namespace ergodome
