#include "content/environment_image.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <cmath>

#include "kernels/core/error.h"

namespace ergodome {

namespace {

constexpr int narrowest = 8;
constexpr int widest = 65'536;
//! Light brighter than this is a broken texel; half floats end at 65504, and the sun in any unit stays far below.
constexpr float brightest = 1e9F;

float decoded_srgb(float encoded) {
  return encoded <= 0.04045F ? encoded / 12.92F : std::pow((encoded + 0.055F) / 1.055F, 2.4F);
}

bool is_encoded(const OIIO::ImageSpec& spec) {
  const bool whole_numbers = spec.format.basetype != OIIO::TypeDesc::FLOAT &&
                             spec.format.basetype != OIIO::TypeDesc::HALF &&
                             spec.format.basetype != OIIO::TypeDesc::DOUBLE;
  return whole_numbers && spec.get_string_attribute("oiio:ColorSpace", "sRGB") != "Linear";
}

void check_shape(const OIIO::ImageSpec& spec, const std::string& name) {
  if (spec.width < narrowest || spec.width > widest || spec.depth > 1) {
    throw Error(name, fmt::format("is {} pixels wide", spec.width),
                fmt::format("a sky map is {} to {} pixels wide", narrowest, widest));
  }
  if (spec.width != 2 * spec.height) {
    throw Error(name, fmt::format("is {} x {}, not twice as wide as high", spec.width, spec.height),
                "convert it to an equirectangular map of the whole sky");
  }
  if (spec.nchannels < 1 || spec.nchannels > 64) {
    throw Error(name, fmt::format("has {} channels", spec.nchannels), "save it as RGB");
  }
}

//! Reads an opened image row by row, adding up blocks of `factor` x `factor` texels.
class MapReader {
 public:
  MapReader(OIIO::ImageInput& input, std::string name, int largest_width)
      : input_(input), name_(std::move(name)), encoded_(is_encoded(input.spec())) {
    const OIIO::ImageSpec& spec = input.spec();
    check_shape(spec, name_);
    while (spec.width / factor_ > largest_width && spec.width % (2 * factor_) == 0 &&
           spec.height % (2 * factor_) == 0) {
      factor_ *= 2;
    }
    if (spec.width / factor_ > largest_width && spec.width > 2 * largest_width) {
      throw Error(name_, fmt::format("is {} pixels wide, which cannot be halved evenly", spec.width),
                  fmt::format("scale it to {} pixels", largest_width));
    }
    image_.name = name_;
    image_.width = spec.width / factor_;
    image_.height = spec.height / factor_;
    image_.rgb.assign(3 * static_cast<std::size_t>(image_.width) * static_cast<std::size_t>(image_.height), 0.0F);
    colour_channels_ = spec.nchannels >= 3 ? 3 : 1;
  }

  EnvironmentImage read() {
    const OIIO::ImageSpec spec = input_.spec();
    constexpr int rows_at_once = 64;
    std::vector<float> rows(static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(colour_channels_) *
                            rows_at_once);
    for (int begin = 0; begin < spec.height; begin += rows_at_once) {
      const int end = std::min(begin + rows_at_once, spec.height);
      if (!read_rows(spec, begin, end, rows)) {
        throw Error(name_, fmt::format("cannot be read at row {}: {}", begin, input_.geterror()),
                    "the file seems torn; save it again");
      }
      for (int y = begin; y < end; ++y) {
        add_row(
            rows.data() + static_cast<std::size_t>(y - begin) * static_cast<std::size_t>(spec.width * colour_channels_),
            y, spec.width);
      }
    }
    if (repaired_ == static_cast<long>(spec.width) * spec.height) {
      throw Error(name_, "holds no finite light at all", "save it again");
    }
    image_.repaired_texels = static_cast<int>(std::min(repaired_, 2'000'000'000L));
    return std::move(image_);
  }

 private:
  bool read_rows(const OIIO::ImageSpec& spec, int begin, int end, std::vector<float>& rows) {
    if (spec.tile_width == 0) {
      return input_.read_scanlines(0, 0, spec.y + begin, spec.y + end, 0, 0, colour_channels_, OIIO::TypeDesc::FLOAT,
                                   rows.data());
    }
    // Tiles are read once and kept: asking for scanlines of them would decode each many times.
    if (tiles_.empty()) {
      if (static_cast<double>(spec.width) * spec.height > 16384.0 * 8192.0) {
        throw Error(name_, fmt::format("is tiled and {} pixels wide", spec.width),
                    "save it in scanlines, or scale it to 16384 pixels");
      }
      tiles_.resize(static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height * colour_channels_));
      if (!input_.read_image(0, 0, 0, colour_channels_, OIIO::TypeDesc::FLOAT, tiles_.data())) {
        return false;
      }
    }
    const auto row_size = static_cast<std::ptrdiff_t>(spec.width) * colour_channels_;
    std::copy(tiles_.begin() + begin * row_size, tiles_.begin() + end * row_size, rows.begin());
    return true;
  }

  void add_row(const float* row, int y, int width) {
    const float share = 1.0F / static_cast<float>(factor_ * factor_);
    float* to = image_.rgb.data() + 3 * static_cast<std::size_t>(y / factor_) * static_cast<std::size_t>(image_.width);
    for (int x = 0; x < width; ++x) {
      float colour[3];
      bool sound = true;
      for (int c = 0; c < 3; ++c) {
        const float value = row[x * colour_channels_ + (colour_channels_ == 3 ? c : 0)];
        sound = sound && value >= 0.0F && value <= brightest;  // false for NaN
        colour[c] = encoded_ ? decoded_srgb(value) : value;
      }
      repaired_ += sound ? 0 : 1;
      for (int c = 0; c < 3; ++c) {
        to[3 * (x / factor_) + c] += sound ? colour[c] * share : 0.0F;
      }
    }
  }

  OIIO::ImageInput& input_;
  std::string name_;
  bool encoded_;
  int factor_ = 1;
  int colour_channels_ = 3;
  long repaired_ = 0;
  std::vector<float> tiles_;
  EnvironmentImage image_;
};

EnvironmentImage read_opened(const std::unique_ptr<OIIO::ImageInput>& input, const std::string& name,
                             int largest_width) {
  if (!input) {
    throw Error(name, "is not an image that can be read: " + OIIO::geterror(),
                "give an equirectangular EXR, HDR, PNG, TIFF or JPEG");
  }
  try {
    return MapReader(*input, name, largest_width).read();
  } catch (const std::bad_alloc&) {
    throw Error(name, "is too large for the memory", "scale it down");
  }
}

}  // namespace

EnvironmentImage read_environment_image(const std::filesystem::path& path, int largest_width) {
  std::error_code problem;
  if (!std::filesystem::is_regular_file(path, problem)) {
    throw Error(path.string(), "is not a file that can be read", "give the path of an equirectangular image");
  }
  return read_opened(OIIO::ImageInput::open(path.string()), path.string(), largest_width);
}

EnvironmentImage read_environment_image(std::span<const std::byte> bytes, const std::string& name, int largest_width) {
  OIIO::Filesystem::IOMemReader memory(bytes.data(), bytes.size());
  return read_opened(OIIO::ImageInput::open(name, nullptr, &memory), name, largest_width);
}

}  // namespace ergodome
