#include "content/sky/environment_image.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <memory>

#include "content/files/printable.h"
#include "content/files/whole_file.h"
#include "content/images/image_library.h"
#include "content/images/plain/plain_jpeg.h"
#include "content/show/show_errors.h"
#include "content/sky/cube_map.h"
#include "kernels/core/error.h"

namespace ergodome {

std::string repair_text(const RepairedTexels& texels) {
  std::string text;
  const auto add = [&](long count, const std::string& what) {
    if (count > 0) {
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", counted(count, "texel"), what);
    }
  };
  add(texels.too_bright, fmt::format("infinite or brighter than {:g} (clamped)", brightest_texel));
  add(texels.below_zero, "with a negative color (set to 0)");
  add(texels.not_numbers, "with a non-finite color (set to black)");
  return text;
}

std::string note_of_repair(const Show& show, const std::string& key, const std::string& name,
                           const RepairedTexels& texels) {
  return named_by(show, key,
                  Error((std::filesystem::path(show.folder) / name).string(), "has " + repair_text(texels),
                        "save the image again without infinite, NaN or negative values"))
      .what();
}

namespace {

constexpr int narrowest = 8;
constexpr int widest = 65'536;

void check_shape(const ImageShape& shape, const std::string& name) {
  if (shape.width < narrowest || shape.width > widest || shape.depth > 1) {
    throw Error(name, fmt::format("is {} pixels wide", shape.width),
                fmt::format("scale it to a width from {} to {} pixels", narrowest, widest));
  }
  if (shape.channels < 1 || shape.channels > 64) {
    throw Error(name, fmt::format("has {} channels", shape.channels), "save it with red, green and blue");
  }
}

Error of_wrong_shape(const std::string& name, const ImageShape& shape) {
  return {name, fmt::format("is {} x {}, neither twice as wide as high nor a cube map", shape.width, shape.height),
          "convert it to an equirectangular (2:1) map of the whole sky"};
}

//! Where the light of one texel in a row of `from` texels goes in a row of `to` texels, with to <=
//! from: the fraction `part` of the texel is in texel `first`, the rest in the next one.
struct TexelPosition {
  int first;
  float part;
};

TexelPosition texel_position(std::int64_t texel, std::int64_t from, std::int64_t to) {
  const std::int64_t first = texel * to / from;
  const std::int64_t inside = std::min(to, (first + 1) * from - texel * to);
  return {static_cast<int>(first), static_cast<float>(static_cast<double>(inside) / static_cast<double>(to))};
}

//! Reads an opened image row by row, and averages its texels into a smaller image.
class MapReader {
 public:
  //! The image is averaged down to `width` x `height` texels, which must not exceed its size.
  MapReader(ImageInput& input, std::string name, int width, int height)
      : input_(input), name_(std::move(name)), coding_(light_coding(input.shape())) {
    const ImageShape& shape = input.shape();
    image_.name = name_;
    image_.file_width = shape.width;
    image_.width = width;
    image_.height = height;
    // Only reserves memory: a truncated file must not allocate what it claims.
    image_.rgb.reserve(floats_of_rows(image_.height));
    columns_.reserve(static_cast<std::size_t>(shape.width));
    for (int x = 0; x < shape.width; ++x) {
      columns_.push_back(texel_position(x, shape.width, image_.width));
    }
    // Only channels that affect the light are read.
    read_channels_ = coding_.light_channels();
  }

  EnvironmentImage read() {
    const ImageShape shape = input_.shape();
    constexpr int rows_at_once = 64;
    std::vector<float> rows(static_cast<std::size_t>(shape.width) * static_cast<std::size_t>(read_channels_) *
                            rows_at_once);
    for (int begin = 0; begin < shape.height; begin += rows_at_once) {
      throw_if_reading_stopped(name_);
      const int end = std::min(begin + rows_at_once, shape.height);
      if (!input_.read_rows(begin, end, read_channels_, rows.data())) {
        throw Error(name_, fmt::format("cannot be read at row {}: {}", begin, input_.error()),
                    "the file seems to be truncated or damaged; save it again");
      }
      make_rows(texel_position(end - 1, shape.height, image_.height).first + 2);
      for (int y = begin; y < end; ++y) {
        add_row(
            rows.data() + static_cast<std::size_t>(y - begin) * static_cast<std::size_t>(shape.width * read_channels_),
            y, shape);
      }
    }
    make_rows(image_.height);
    if (image_.repaired.not_numbers == static_cast<long>(shape.width) * shape.height) {
      throw Error(name_, "contains no finite colors", "save it again");
    }
    return std::move(image_);
  }

 private:
  [[nodiscard]] std::size_t floats_of_rows(int rows) const {
    return 3 * static_cast<std::size_t>(image_.width) * static_cast<std::size_t>(rows);
  }

  //! Appends black rows to the image until it has `rows` rows.
  void make_rows(int rows) {
    image_.rgb.resize(std::max(image_.rgb.size(), floats_of_rows(std::min(rows, image_.height))));
  }

  void add_row(const float* row, int y, const ImageShape& shape) {
    const double scale = static_cast<double>(image_.width) / shape.width;
    const auto whole = static_cast<float>(scale * scale);
    const TexelPosition down = texel_position(y, shape.height, image_.height);
    for (int x = 0; x < shape.width; ++x) {
      const float* const pixel = row + static_cast<std::ptrdiff_t>(x) * read_channels_;
      float colour[3];
      coding_.put_light(pixel, colour);
      repair(colour);
      const TexelPosition& across = columns_[static_cast<std::size_t>(x)];
      add_texel(across.first, down, colour, whole * across.part);
      if (across.part < 1.0F) {
        add_texel(across.first + 1, down, colour, whole * (1.0F - across.part));
      }
    }
  }

  void add_texel(int x, const TexelPosition& down, const float (&colour)[3], float share) {
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

  //! Replaces an invalid color of a texel by valid light, and counts it.
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
    // Only the negative components become 0; the others keep their light.
    std::ranges::transform(colour, colour, [](float light) {
      return std::isinf(light) && light > 0.0F ? infinite_texel : std::clamp(light, 0.0F, brightest_texel);
    });
  }

  ImageInput& input_;
  std::string name_;
  LightCoding coding_;
  int read_channels_ = 3;  //!< number of channels read per pixel
  //! For each texel of a row of the file, its position in the smaller image.
  std::vector<TexelPosition> columns_;
  EnvironmentImage image_;
};

ImageLibrary::Wishes sky_wishes(std::optional<std::span<const std::byte>> bytes, const std::string& layer) {
  return {.bytes = bytes,
          .separate_alpha = true,
          .as_stored = false,
          .as_light = true,
          .as_panorama = true,
          .layer = layer};
}

EnvironmentImage read_shape(ImageInput& input, const std::string& name, int largest_width) {
  const ImageShape shape = input.shape();
  check_shape(shape, name);
  if (shape.width == 2 * shape.height) {
    // The widths of file and result are even, because each image is twice as wide as high.
    const int width = std::min(shape.width, largest_width / 2 * 2);
    return MapReader(input, name, width, width / 2).read();
  }
  const bool openexr_cube = input.text("textureformat") == "CubeFace Environment" && input.text("format") == "openexr";
  const auto layout = cube_map_layout(shape.width, shape.height, openexr_cube);
  if (!layout) {
    throw of_wrong_shape(name, shape);
  }
  const auto [columns, rows] = faces_of(*layout);
  const int side = std::min(shape.width / columns, largest_width / 4);
  const EnvironmentImage cube = MapReader(input, name, columns * side, rows * side).read();
  if (!has_plain_corners(cube, *layout)) {
    throw of_wrong_shape(name, shape);
  }
  return equirectangular_from_cube(cube, *layout, 4 * side);
}

EnvironmentImage read_with(const ImageLibrary::Wishes& wishes, const std::string& name, int largest_width) {
  std::string problem;
  auto input = wishes.bytes || !wishes.layer.empty() ? nullptr : open_plain_jpeg(name);
  if (!input) {
    input = image_library().open(name, wishes, problem);
  }
  if (!input) {
    throw Error(name, "cannot be read as an image: " + problem,
                "use an equirectangular EXR, HDR, PNG, TIFF or JPEG image");
  }
  try {
    return read_shape(*input, name, largest_width);
  } catch (const std::bad_alloc&) {
    throw Error(name, "does not fit into memory", "scale it down");
  }
}

}  // namespace

LayeredFile layered_file(const std::filesystem::path& name) {
  std::error_code problem;
  const std::string text = name.string();
  const std::size_t mark = text.rfind('#');
  if (mark == std::string::npos || std::filesystem::exists(name, problem)) {
    return {name, ""};
  }
  return {text.substr(0, mark), text.substr(mark + 1)};
}

EnvironmentImage read_environment_image(const std::filesystem::path& name, int largest_width) {
  std::error_code problem;
  const auto [path, layer] = layered_file(name);
  if (!std::filesystem::is_regular_file(path, problem)) {
    throw Error(path.string(), "does not exist or is not a regular file", "give the path of an equirectangular image");
  }
  return read_with(sky_wishes(std::nullopt, layer), path.string(), largest_width);
}

EnvironmentImage read_environment_image(std::span<const std::byte> bytes, const std::string& name, int largest_width) {
  return read_with(sky_wishes(bytes, {}), name, largest_width);
}

}  // namespace ergodome
