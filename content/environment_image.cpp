#include "content/environment_image.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>

#include "content/files/reading_stop.h"
#include "content/images/image_library.h"
#include "content/images/light_coding.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

constexpr int narrowest = 8;
constexpr int widest = 65'536;

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

//! Where one of `from` texels in a row lies in a row of `to`, no more of them: in the first it has this part, and the rest in the next.
struct TexelPlace {
  int first;
  float part;
};

TexelPlace texel_place(std::int64_t texel, std::int64_t from, std::int64_t to) {
  const std::int64_t first = texel * to / from;
  const std::int64_t inside = std::min(to, (first + 1) * from - texel * to);
  return {static_cast<int>(first), static_cast<float>(static_cast<double>(inside) / static_cast<double>(to))};
}

//! Reads an opened image row by row, adding up the texels that fall into each of a smaller one.
class MapReader {
 public:
  MapReader(ImageInput& input, std::string name, int largest_width)
      : input_(input), name_(std::move(name)), coding_(light_coding(input.shape())) {
    const ImageShape& shape = input.shape();
    check_shape(shape, name_);
    image_.name = name_;
    image_.file_width = shape.width;
    // Both of an even width, as the image is twice as wide as high.
    image_.width = std::min(shape.width, largest_width / 2 * 2);
    image_.height = image_.width / 2;
    // Room alone: a file that breaks off shall not take the memory of what it claims.
    image_.rgb.reserve(floats_of_rows(image_.height));
    columns_.reserve(static_cast<std::size_t>(shape.width));
    for (int x = 0; x < shape.width; ++x) {
      columns_.push_back(texel_place(x, shape.width, image_.width));
    }
    // Other channels are not looked at.
    read_channels_ = coding_.light_channels();
  }

  EnvironmentImage read() {
    const ImageShape shape = input_.shape();
    constexpr int rows_at_once = 64;
    std::vector<float> rows(static_cast<std::size_t>(shape.width) * static_cast<std::size_t>(read_channels_) *
                            rows_at_once);
    for (int begin = 0; begin < shape.height; begin += rows_at_once) {
      require_reading_goes_on(name_);
      const int end = std::min(begin + rows_at_once, shape.height);
      if (!read_rows(shape, begin, end, rows)) {
        throw Error(name_, fmt::format("cannot be read at row {}: {}", begin, input_.error()),
                    "the file seems torn; save it again");
      }
      make_rows(texel_place(end - 1, shape.height, image_.height).first + 2);
      for (int y = begin; y < end; ++y) {
        add_row(
            rows.data() + static_cast<std::size_t>(y - begin) * static_cast<std::size_t>(shape.width * read_channels_),
            y, shape.width);
      }
    }
    make_rows(image_.height);
    if (image_.repaired.not_numbers == static_cast<long>(shape.width) * shape.height) {
      throw Error(name_, "holds no light that is a number", "save it again");
    }
    return std::move(image_);
  }

 private:
  [[nodiscard]] std::size_t floats_of_rows(int rows) const {
    return 3 * static_cast<std::size_t>(image_.width) * static_cast<std::size_t>(rows);
  }

  //! Makes the first rows of the image, black, where they are not there yet.
  void make_rows(int rows) {
    image_.rgb.resize(std::max(image_.rgb.size(), floats_of_rows(std::min(rows, image_.height))));
  }

  bool read_rows(const ImageShape& shape, int begin, int end, std::vector<float>& rows) {
    if (!shape.tiled) {
      return input_.read_rows(begin, end, read_channels_, rows.data());
    }
    // Tiles are read once and kept: asking for scanlines of them would decode each many times.
    if (!tiles_) {
      if (static_cast<double>(shape.width) * shape.height > 16384.0 * 8192.0) {
        throw Error(name_, fmt::format("is tiled and {} pixels wide", shape.width),
                    "save it in scanlines, or scale it to 16384 pixels");
      }
      tiles_ = std::make_unique_for_overwrite<float[]>(static_cast<std::size_t>(shape.width) *
                                                       static_cast<std::size_t>(shape.height * read_channels_));
      if (!input_.read_all(read_channels_, tiles_.get())) {
        return false;
      }
    }
    const auto row_size = static_cast<std::ptrdiff_t>(shape.width) * read_channels_;
    std::copy(tiles_.get() + begin * row_size, tiles_.get() + end * row_size, rows.begin());
    return true;
  }

  void add_row(const float* row, int y, int width) {
    const double scale = static_cast<double>(image_.width) / width;
    const auto whole = static_cast<float>(scale * scale);
    const TexelPlace down = texel_place(y, width / 2, image_.height);
    for (int x = 0; x < width; ++x) {
      const float* const pixel = row + static_cast<std::ptrdiff_t>(x) * read_channels_;
      float colour[3];
      coding_.put_light(pixel, colour);
      repair(colour);
      const TexelPlace& across = columns_[static_cast<std::size_t>(x)];
      add_texel(across.first, down, colour, whole * across.part);
      if (across.part < 1.0F) {
        add_texel(across.first + 1, down, colour, whole * (1.0F - across.part));
      }
    }
  }

  void add_texel(int x, const TexelPlace& down, const float (&colour)[3], float share) {
    const auto add = [&](int y, float part) {
      if (part > 0.0F) {
        float* const to = image_.rgb.data() + 3 * (static_cast<std::ptrdiff_t>(y) * image_.width + x);
        for (int c = 0; c < 3; ++c) {
          to[c] += colour[c] * part;
        }
      }
    };
    add(down.first, share * down.part);
    add(down.first + 1, share * (1.0F - down.part));
  }

  //! Makes light of a texel, and counts it where it was none.
  void repair(float (&colour)[3]) {
    if (std::ranges::all_of(colour, [](float light) { return light >= 0.0F && light <= brightest_texel; })) {
      return;
    }
    if (std::ranges::any_of(colour, [](float light) { return std::isnan(light); })) {
      ++image_.repaired.not_numbers;
      std::ranges::fill(colour, 0.0F);
    } else if (std::ranges::max(colour) > brightest_texel) {
      ++image_.repaired.too_bright;
    } else {
      ++image_.repaired.below_zero;
    }
    // A colour below zero is no light; the others are.
    std::ranges::transform(colour, colour, [](float light) {
      return std::isinf(light) && light > 0.0F ? infinite_texel : std::clamp(light, 0.0F, brightest_texel);
    });
  }

  ImageInput& input_;
  std::string name_;
  LightCoding coding_;
  int read_channels_ = 3;            //!< of a pixel
  std::vector<TexelPlace> columns_;  //!< where texels of a row fall
  std::unique_ptr<float[]> tiles_;
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
