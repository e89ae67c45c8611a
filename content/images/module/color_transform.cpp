#include "content/images/module/color_transform.h"

#include <fmt/format.h>
#include <lcms2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <thread>

#include "kernels/image/color_map.h"

namespace ergodome {

namespace {

struct CloseProfile {
  void operator()(void* profile) const { cmsCloseProfile(profile); }
};
using Profile = std::unique_ptr<void, CloseProfile>;

constexpr cmsCIExyY d65 = {rec_709[6], rec_709[7], 1.0};

Profile linear_rgb_profile(const Chromaticities& p) {
  const cmsCIExyY white = {p[6], p[7], 1.0};
  const cmsCIExyYTRIPLE primaries = {{p[0], p[1], 1.0}, {p[2], p[3], 1.0}, {p[4], p[5], 1.0}};
  cmsToneCurve* const curve = cmsBuildGamma(nullptr, 1.0);
  cmsToneCurve* const curves[3] = {curve, curve, curve};
  Profile profile(cmsCreateRGBProfile(&white, &primaries, curves));
  cmsFreeToneCurve(curve);
  return profile;
}

Profile linear_grey_profile() {
  cmsToneCurve* const curve = cmsBuildGamma(nullptr, 1.0);
  Profile profile(cmsCreateGrayProfile(&d65, curve));
  cmsFreeToneCurve(curve);
  return profile;
}

//! Returns LittleCMS's conversion of floats from a profile to linear light; null if it cannot
//! create one.
std::shared_ptr<void> conversion_from(void* from, int color_channels) {
  if (from == nullptr) {
    return nullptr;
  }
  const bool grey = color_channels == 1;
  const Profile to = grey ? linear_grey_profile() : linear_rgb_profile(rec_709);
  const cmsUInt32Number format = grey ? TYPE_GRAY_FLT : TYPE_RGB_FLT;
  std::shared_ptr<void> conversion(
      cmsCreateTransform(from, format, to.get(), format, INTENT_RELATIVE_COLORIMETRIC, cmsFLAGS_NOCACHE),
      [](void* transform) {
        if (transform != nullptr) {
          cmsDeleteTransform(transform);
        }
      });
  return conversion;
}

//! Inverts Rec. 709's opto-electronic transfer function (ITU-R BT.709-6, 1.2).
float bt709_decoded(float value) {
  return value < 0.081F ? value / 4.5F : std::pow((value + 0.099F) / 1.099F, 1.0F / 0.45F);
}

//! Decodes the perceptual quantizer (SMPTE ST 2084); 1 is the reference white of 203 cd/m² (ITU-R
//! BT.2408).
float pq_decoded(float value) {
  constexpr float m1 = 2610.0F / 16384.0F;
  constexpr float m2 = 2523.0F / 4096.0F * 128.0F;
  constexpr float c1 = 3424.0F / 4096.0F;
  constexpr float c2 = 2413.0F / 4096.0F * 32.0F;
  constexpr float c3 = 2392.0F / 4096.0F * 32.0F;
  const float power = std::pow(std::clamp(value, 0.0F, 1.0F), 1.0F / m2);
  return 10'000.0F / 203.0F * std::pow(std::max(power - c1, 0.0F) / (c2 - c3 * power), 1.0F / m1);
}

std::function<float(float)> decoding(const ColorMetadata& metadata) {
  switch (metadata.curve) {
    case TransferCurve::linear:
      return {};
    case TransferCurve::srgb:
      return srgb_decoded;
    case TransferCurve::bt709:
      return bt709_decoded;
    case TransferCurve::pq:
      return pq_decoded;
    case TransferCurve::gamma:
      break;
  }
  return [exponent = static_cast<float>(metadata.gamma)](float value) {
    return std::pow(std::max(value, 0.0F), exponent);
  };
}

//! Returns true if the primaries are CIE X, Y and Z.
bool are_xyz(const Chromaticities& p) {
  constexpr std::array<double, 6> xyz = {1.0, 0.0, 0.0, 1.0, 0.0, 0.0};
  return std::equal(xyz.begin(), xyz.end(), p.begin(), [](double a, double b) { return std::abs(a - b) < 1e-4; });
}

bool are_rec_709(const Chromaticities& p) {
  return std::equal(rec_709.begin(), rec_709.end(), p.begin(),
                    [](double a, double b) { return std::abs(a - b) < 1e-3; });
}

const char* name_of_space(cmsColorSpaceSignature space) {
  switch (space) {
    case cmsSigRgbData:
      return "RGB";
    case cmsSigGrayData:
      return "gray";
    case cmsSigCmykData:
      return "CMYK";
    default:
      return "other";
  }
}

}  // namespace

ColorTransform::ColorTransform(const ColorMetadata& metadata, int color_channels, std::string& problem)
    : color_channels_(color_channels) {
  // Without a handler, LittleCMS writes its messages to stderr.
  cmsSetLogErrorHandler([](cmsContext, cmsUInt32Number, const char*) {});
  if (!metadata.icc_profile.empty()) {
    const Profile profile(
        cmsOpenProfileFromMem(metadata.icc_profile.data(), static_cast<cmsUInt32Number>(metadata.icc_profile.size())));
    const bool grey = color_channels == 1;
    if (profile && cmsGetColorSpace(profile.get()) != (grey ? cmsSigGrayData : cmsSigRgbData)) {
      problem = fmt::format("its color profile is for {} colors, but its pixels are {}",
                            name_of_space(cmsGetColorSpace(profile.get())), grey ? "gray" : "RGB");
      return;
    }
    conversion_ = conversion_from(profile.get(), color_channels);
    if (!conversion_) {
      problem = "its color profile is damaged; save the image without it, or convert it to sRGB";
      return;
    }
  } else {
    decode_ = decoding(metadata);
    is_linear_ = !decode_;
    if (metadata.primaries && color_channels == 3 && !are_rec_709(*metadata.primaries)) {
      Chromaticities p = *metadata.primaries;
      if (are_xyz(p) && !metadata.adapts_xyz) {
        // These numbers are absolute XYZ colors, so their white is not adapted.
        scale_ = {static_cast<float>(d65.y / d65.x), 1.0F, static_cast<float>(d65.y / (1.0 - d65.x - d65.y))};
        p[6] = d65.x;
        p[7] = d65.y;
      }
      const bool plausible = std::ranges::all_of(p, [](double value) { return std::abs(value) <= 2.0; }) && p[7] > 0.01;
      const Profile profile = plausible ? linear_rgb_profile(p) : nullptr;
      conversion_ = conversion_from(profile.get(), color_channels);
      if (!conversion_) {
        problem = "the chromaticities of its primaries do not define a color space";
        return;
      }
    }
  }
  find_kind();
}

void ColorTransform::find_kind() {
  constexpr float tolerance = 0.002F;
  is_srgb_ = is_identity_ = true;
  // Converts test colors: grays show whether the curve is sRGB or the identity, pure colors whether
  // the matrix is the identity.
  for (int step = 0; step <= 16; ++step) {
    for (int color = -1; color < (color_channels_ == 3 ? 3 : 0); ++color) {
      const float value = static_cast<float>(step) / 16.0F;
      std::array<float, 3> in{};
      for (int c = 0; c < 3; ++c) {
        in.at(static_cast<std::size_t>(c)) = color < 0 || color == c ? value : 0.0F;
      }
      std::array<float, 3> out = in;
      convert(out.data(), 1);
      for (int c = 0; c < color_channels_; ++c) {
        const auto at = static_cast<std::size_t>(c);
        is_identity_ = is_identity_ && std::abs(out.at(at) - in.at(at)) <= tolerance;
        is_srgb_ = is_srgb_ && std::abs(out.at(at) - srgb_decoded(in.at(at))) <= tolerance;
      }
    }
  }
}

void ColorTransform::convert(float* colors, std::size_t count) const {
  const auto per_pixel = static_cast<std::size_t>(color_channels_);
  if (decode_) {
    std::transform(colors, colors + count * per_pixel, colors, decode_);
  }
  if (!scale_.empty()) {
    for (std::size_t i = 0; i < count * per_pixel; ++i) {
      colors[i] *= scale_[i % per_pixel];
    }
  }
  if (conversion_) {
    cmsDoTransform(conversion_.get(), colors, colors, static_cast<cmsUInt32Number>(count));
  }
}

void ColorTransform::apply(float* pixels, std::size_t count, int channels, int alpha) const {
  constexpr std::size_t min_pixels = 32'768;
  const std::size_t parts =
      std::clamp<std::size_t>(count / min_pixels, 1, std::max(1U, std::thread::hardware_concurrency()));
  std::vector<std::jthread> others;
  for (std::size_t part = 1; part < parts; ++part) {
    const std::size_t begin = part * count / parts;
    const std::size_t end = (part + 1) * count / parts;
    others.emplace_back([this, begin, end, pixels, channels, alpha] {
      apply_here(pixels + begin * static_cast<std::size_t>(channels), end - begin, channels, alpha);
    });
  }
  apply_here(pixels, count / parts, channels, alpha);
}

void ColorTransform::apply_here(float* pixels, std::size_t count, int channels, int alpha) const {
  constexpr std::size_t at_once = 1024;
  const auto stride = static_cast<std::size_t>(channels);
  const auto per_pixel = static_cast<std::size_t>(std::min(color_channels_, channels));
  std::array<float, at_once * 3> colors{};
  for (std::size_t begin = 0; begin < count; begin += at_once) {
    const std::size_t part = std::min(at_once, count - begin);
    for (std::size_t i = 0; i < part; ++i) {
      const float* const pixel = pixels + (begin + i) * stride;
      const float cover = alpha >= 0 && alpha < channels && pixel[alpha] > 0.0F ? pixel[alpha] : 1.0F;
      for (std::size_t c = 0; c < per_pixel; ++c) {
        colors.at(i * per_pixel + c) = pixel[c] / cover;
      }
    }
    convert(colors.data(), part);
    for (std::size_t i = 0; i < part; ++i) {
      std::copy_n(colors.data() + i * per_pixel, per_pixel, pixels + (begin + i) * stride);
    }
  }
}

}  // namespace ergodome
