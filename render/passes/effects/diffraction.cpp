#include "render/passes/effects/diffraction.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "content/images/image_library.h"
#include "kernels/core/error.h"
#include "kernels/image/color_map.h"
#include "kernels/launch/parallel_for.h"
#include "kernels/sky/blackbody.h"

namespace ergodome {

namespace {

constexpr int widest_px = 1025;
constexpr double shortest_nm = 400.0;
constexpr double longest_nm = 700.0;

//! A wavelength [nm] and its contribution to red, green and blue of white light.
struct SpectralLine {
  double wavelength_nm;
  Vector3<double> rgb;
};

//! Returns `count` wavelengths of an equal-energy spectrum.
std::vector<SpectralLine> white_spectrum(int count) {
  std::vector<SpectralLine> lines;
  for (int i = 0; i < count; ++i) {
    const double wavelength_nm = shortest_nm + (longest_nm - shortest_nm) * (i + 0.5) / count;
    lines.push_back({wavelength_nm, linear_srgb(cie_matching(wavelength_nm))});
  }
  return lines;
}

//! Adds the light of a spectral line to a row of the pattern.
void add_line(const FarField& field, const SpectralLine& line, int size_px, int row, float* rgb) {
  const double left = -0.5 * size_px;
  const double top = row + left;
  const auto in_row = [&](double x_px) {
    return field.light_before(x_px, top + 1.0, line.wavelength_nm) - field.light_before(x_px, top, line.wavelength_nm);
  };
  double before = in_row(left);
  for (int x = 0; x < size_px; ++x) {
    const double after = in_row(left + x + 1.0);
    const double light = after - before;
    rgb[3 * x] += static_cast<float>(light * line.rgb.x);
    rgb[3 * x + 1] += static_cast<float>(light * line.rgb.y);
    rgb[3 * x + 2] += static_cast<float>(light * line.rgb.z);
    before = after;
  }
}

//! Clamps negative light to 0 and normalizes each channel to a sum of 1. Returns false if a channel
//! is black.
bool normalise(std::vector<float>& rgb) {
  for (std::size_t c = 0; c < 3; ++c) {
    double sum = 0.0;
    for (std::size_t i = c; i < rgb.size(); i += 3) {
      rgb[i] = std::max(rgb[i], 0.0F);
      sum += static_cast<double>(rgb[i]);
    }
    if (!(sum > 0.0)) {
      return false;
    }
    for (std::size_t i = c; i < rgb.size(); i += 3) {
      rgb[i] = static_cast<float>(static_cast<double>(rgb[i]) / sum);
    }
  }
  return true;
}

//! Pixels of an image file, linear, three floats each.
struct Image {
  int width;
  int height;
  std::vector<float> rgb;
};

Image read_image(const std::string& name) {
  std::string problem;
  ImageLibrary::Wishes wishes;
  wishes.separate_alpha = wishes.as_light = true;
  const auto input = image_library().open(name, wishes, problem);
  if (!input) {
    throw Error(name, "cannot be read as an image: " + problem, "use an EXR, HDR, PNG, TIFF or JPEG file");
  }
  const ImageShape shape = input->shape();
  constexpr int max_channels = 64;
  if (shape.channels < 1 || shape.channels > max_channels) {
    throw Error(name, fmt::format("has {} channels", shape.channels), "save it as RGB");
  }
  if (shape.width < 1 || shape.height < 1 || shape.width > widest_px || shape.height > widest_px || shape.depth > 1) {
    throw Error(name, fmt::format("is {} x {} pixels, too large", shape.width, shape.height),
                fmt::format("scale the pattern to at most {} x {}", widest_px, widest_px));
  }
  const LightCoding coding = light_coding(shape);
  const auto channels = static_cast<std::size_t>(coding.light_channels());
  const std::size_t pixels = static_cast<std::size_t>(shape.width) * static_cast<std::size_t>(shape.height);
  std::vector<float> values(pixels * channels);
  if (!input->read_all(static_cast<int>(channels), values.data())) {
    throw Error(name, "cannot be read: " + input->error(), "the file is truncated or damaged; save it again");
  }
  Image image{shape.width, shape.height, std::vector<float>(3 * pixels)};
  for (std::size_t i = 0; i < pixels; ++i) {
    coding.put_light(values.data() + channels * i, image.rgb.data() + 3 * i);
  }
  if (!std::ranges::all_of(image.rgb, [](float light) { return std::isfinite(light); })) {
    throw Error(name, "contains non-finite values", "save it again without NaN and infinity");
  }
  return image;
}

//! Calls body(pixel, part) for the one or two pixels that the interval from `start` to `start` + 1
//! covers, with the covered part.
template <class Body>
void for_covered(double start, const Body& body) {
  const double first = std::floor(start);
  body(static_cast<int>(first), static_cast<float>(1.0 - (start - first)));
  if (start > first) {
    body(static_cast<int>(first) + 1, static_cast<float>(start - first));
  }
}

}  // namespace

DiffractionPattern diffraction_pattern(const ApertureSettings& settings) {
  const FarField field(settings);
  // The rings of neighboring wavelengths move apart with increasing order. With this number of
  // wavelengths they differ by less than half a ring up to the sides of the square, so that the
  // rings merge there.
  const int lines = std::clamp(static_cast<int>(settings.size_px / (3.0 * settings.scale)), 24, 128);
  const std::vector<SpectralLine> spectrum = white_spectrum(lines);
  const auto size = static_cast<std::size_t>(settings.size_px);
  DiffractionPattern pattern{settings.size_px, std::vector<float>(3 * size * size)};
  parallel_for(settings.size_px, 8, [&](int begin, int end) {
    for (int row = begin; row < end; ++row) {
      for (const SpectralLine& line : spectrum) {
        add_line(field, line, settings.size_px, row, pattern.rgb.data() + 3 * static_cast<std::size_t>(row) * size);
      }
    }
  });
  normalise(pattern.rgb);
  return pattern;
}

DiffractionPattern load_diffraction_pattern(const std::filesystem::path& path) {
  std::error_code problem;
  if (!std::filesystem::is_regular_file(path, problem)) {
    throw Error(path.string(), "is not a readable file", "name an image of a diffraction pattern");
  }
  const Image image = read_image(path.string());
  DiffractionPattern pattern;
  pattern.size_px = std::max(image.width, image.height) | 1;
  const auto size = static_cast<std::size_t>(pattern.size_px);
  pattern.rgb.resize(3 * size * size);
  // If the file's size is even, its center lies between pixels, and each pixel is split among
  // neighbors.
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const float* from = image.rgb.data() + 3 * static_cast<std::size_t>(y * image.width + x);
      for_covered(y + 0.5 * (pattern.size_px - image.height), [&](int row, float down) {
        for_covered(x + 0.5 * (pattern.size_px - image.width), [&](int column, float across) {
          float* to = pattern.rgb.data() + 3 * static_cast<std::size_t>(row * pattern.size_px + column);
          for (int c = 0; c < 3; ++c) {
            to[c] += down * across * from[c];
          }
        });
      });
    }
  }
  if (!normalise(pattern.rgb)) {
    throw Error(path.string(), "has a color channel without light", "use the pattern of white light, or a gray image");
  }
  return pattern;
}

void add_diffraction(const DiffractionPattern& pattern, double x_px, double y_px, const Vector3<float>& light,
                     const PixelBlock& block) {
  const int size = pattern.size_px;
  const double left = x_px - 0.5 * size;
  const double top = y_px - 0.5 * size;
  // The condition also rejects non-finite positions.
  if (!(left > block.first_column - size - 1.0 && left < block.end_column && top > -size - 1.0 && top < block.height)) {
    return;
  }
  for (int y = 0; y < size; ++y) {
    for_covered(top + y, [&](int row, float down) {
      if (row < 0 || row >= block.height) {
        return;
      }
      float* to = block.rgba + 4 * static_cast<std::size_t>(row) * static_cast<std::size_t>(block.width);
      const float* from = pattern.rgb.data() + 3 * static_cast<std::size_t>(y) * static_cast<std::size_t>(size);
      for_covered(left, [&](int column, float across) {
        const float part = down * across;
        for (int x = std::max(0, block.first_column - column); x < std::min(size, block.end_column - column); ++x) {
          to[4 * (column + x)] += part * light.x * from[3 * x];
          to[4 * (column + x) + 1] += part * light.y * from[3 * x + 1];
          to[4 * (column + x) + 2] += part * light.z * from[3 * x + 2];
        }
      });
    });
  }
}

}  // namespace ergodome
