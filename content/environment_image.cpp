#include "content/environment_image.h"

#include <fmt/format.h>

#include <cmath>

#include "content/images/image_library.h"
#include "content/images/light_coding.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

constexpr int narrowest = 8;
constexpr int widest = 65'536;
//! Light brighter than this is a broken texel; half floats end at 65504, and the sun in any unit stays far below.
constexpr float brightest = 1e9F;

void check_shape(const ImageShape& shape, const std::string& name) {
  if (shape.width < narrowest || shape.width > widest || shape.depth > 1) {
    throw Error(name, fmt::format("is {} pixels wide", shape.width),
                fmt::format("a sky map is {} to {} pixels wide", narrowest, widest));
  }
  if (shape.width != 2 * shape.height) {
    throw Error(name, fmt::format("is {} x {}, not twice as wide as high", shape.width, shape.height),
                "convert it to an equirectangular map of the whole sky");
  }
  if (shape.channels < 1 || shape.channels > 64) {
    throw Error(name, fmt::format("has {} channels", shape.channels), "save it as RGB");
  }
}

//! Reads an opened image row by row, adding up blocks of `factor` x `factor` texels.
class MapReader {
 public:
  MapReader(ImageInput& input, std::string name, int largest_width)
      : input_(input), name_(std::move(name)), coding_(light_coding(input.shape())) {
    const ImageShape& shape = input.shape();
    check_shape(shape, name_);
    while (shape.width / factor_ > largest_width && shape.width % (2 * factor_) == 0 &&
           shape.height % (2 * factor_) == 0) {
      factor_ *= 2;
    }
    if (shape.width / factor_ > largest_width && shape.width > 2 * largest_width) {
      throw Error(name_, fmt::format("is {} pixels wide, which cannot be halved evenly", shape.width),
                  fmt::format("scale it to {} pixels", largest_width));
    }
    image_.name = name_;
    image_.width = shape.width / factor_;
    image_.height = shape.height / factor_;
    image_.rgb.assign(3 * static_cast<std::size_t>(image_.width) * static_cast<std::size_t>(image_.height), 0.0F);
    // Other channels are not looked at.
    read_channels_ = coding_.light_channels();
  }

  EnvironmentImage read() {
    const ImageShape shape = input_.shape();
    constexpr int rows_at_once = 64;
    std::vector<float> rows(static_cast<std::size_t>(shape.width) * static_cast<std::size_t>(read_channels_) *
                            rows_at_once);
    for (int begin = 0; begin < shape.height; begin += rows_at_once) {
      const int end = std::min(begin + rows_at_once, shape.height);
      if (!read_rows(shape, begin, end, rows)) {
        throw Error(name_, fmt::format("cannot be read at row {}: {}", begin, input_.error()),
                    "the file seems torn; save it again");
      }
      for (int y = begin; y < end; ++y) {
        add_row(
            rows.data() + static_cast<std::size_t>(y - begin) * static_cast<std::size_t>(shape.width * read_channels_),
            y, shape.width);
      }
    }
    if (repaired_ == static_cast<long>(shape.width) * shape.height) {
      throw Error(name_, "holds no finite light at all", "save it again");
    }
    image_.repaired_texels = static_cast<int>(std::min(repaired_, 2'000'000'000L));
    return std::move(image_);
  }

 private:
  bool read_rows(const ImageShape& shape, int begin, int end, std::vector<float>& rows) {
    if (!shape.tiled) {
      return input_.read_rows(begin, end, read_channels_, rows.data());
    }
    // Tiles are read once and kept: asking for scanlines of them would decode each many times.
    if (tiles_.empty()) {
      if (static_cast<double>(shape.width) * shape.height > 16384.0 * 8192.0) {
        throw Error(name_, fmt::format("is tiled and {} pixels wide", shape.width),
                    "save it in scanlines, or scale it to 16384 pixels");
      }
      tiles_.resize(static_cast<std::size_t>(shape.width) * static_cast<std::size_t>(shape.height * read_channels_));
      if (!input_.read_all(read_channels_, tiles_.data())) {
        return false;
      }
    }
    const auto row_size = static_cast<std::ptrdiff_t>(shape.width) * read_channels_;
    std::copy(tiles_.begin() + begin * row_size, tiles_.begin() + end * row_size, rows.begin());
    return true;
  }

  void add_row(const float* row, int y, int width) {
    const float share = 1.0F / static_cast<float>(factor_ * factor_);
    float* to = image_.rgb.data() + 3 * static_cast<std::size_t>(y / factor_) * static_cast<std::size_t>(image_.width);
    for (int x = 0; x < width; ++x) {
      const float* const pixel = row + static_cast<std::ptrdiff_t>(x) * read_channels_;
      float colour[3];
      coding_.put_light(pixel, colour);
      bool sound = true;
      for (float& light : colour) {
        sound = sound && light >= -brightest && light <= brightest;  // false for NaN
        // What filters and changes of gamut leave below zero is no light; the other colours are.
        light = std::max(light, 0.0F);
      }
      repaired_ += sound ? 0 : 1;
      for (int c = 0; c < 3; ++c) {
        to[3 * (x / factor_) + c] += sound ? colour[c] * share : 0.0F;
      }
    }
  }

  ImageInput& input_;
  std::string name_;
  LightCoding coding_;
  int factor_ = 1;
  int read_channels_ = 3;  //!< of a pixel
  long repaired_ = 0;
  std::vector<float> tiles_;
  EnvironmentImage image_;
};

EnvironmentImage read_with(const ImageLibrary::Wishes& wishes, const std::string& name, int largest_width) {
  std::string problem;
  const auto input = image_library().open(name, wishes, problem);
  if (!input) {
    throw Error(name, "is not an image that can be read: " + problem,
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
  return read_with({std::nullopt, true}, path.string(), largest_width);
}

EnvironmentImage read_environment_image(std::span<const std::byte> bytes, const std::string& name, int largest_width) {
  return read_with({bytes, true}, name, largest_width);
}

}  // namespace ergodome
