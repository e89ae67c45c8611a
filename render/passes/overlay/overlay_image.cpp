#include "render/passes/overlay/overlay_image.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "content/files/whole_file.h"
#include "content/images/image_library.h"
#include "kernels/core/error.h"
#include "kernels/launch/parallel_for.h"

namespace ergodome {

namespace {

constexpr int rows_at_a_time = 64;

std::uint16_t whole_number(float value) {
  return static_cast<std::uint16_t>(std::lrint(65535.0F * std::min(value > 0.0F ? value : 0.0F, 1.0F)));
}

int level_size(int size, int level) { return std::max(size >> level, 1); }

//! Sets the size of an image and the offsets of its levels. Returns the number of values of all
//! texels.
std::size_t lay_out(OverlayImage& image, int width, int height) {
  image.width = width;
  image.height = height;
  long texels = 0;
  do {
    image.level_offset.at(static_cast<std::size_t>(image.level_count)) = texels;
    texels += static_cast<long>(level_size(width, image.level_count)) * level_size(height, image.level_count);
    ++image.level_count;
  } while (level_size(width, image.level_count - 1) > 1 || level_size(height, image.level_count - 1) > 1);
  return 4 * static_cast<std::size_t>(texels);
}

//! Returns an image with memory for all levels.
OverlayImage empty_image(int width, int height) {
  OverlayImage image;
  image.texels.resize(lay_out(image, width, height));
  return image;
}

//! The texels of the next finer level that a texel covers along one side, and their weights. There
//! are up to three if the finer size is odd.
struct Covered {
  int first;
  int count;
  std::array<float, 4> weight;
};

Covered covered_texels(int coarse, int coarse_size, int fine_size) {
  const double ratio = static_cast<double>(fine_size) / coarse_size;
  const double from = coarse * ratio;
  const double to = from + ratio;
  Covered covered{static_cast<int>(from), 0, {}};
  for (int i = covered.first; i < std::min(fine_size, covered.first + 4) && i < to; ++i) {
    const double part = std::min(to, i + 1.0) - std::max(from, static_cast<double>(i));
    covered.weight.at(static_cast<std::size_t>(covered.count++)) = static_cast<float>(part / ratio);
  }
  return covered;
}

void make_level(OverlayImage& image, int level) {
  const int width = level_size(image.width, level);
  const int height = level_size(image.height, level);
  const int fine_width = level_size(image.width, level - 1);
  const int fine_height = level_size(image.height, level - 1);
  const auto at = static_cast<std::size_t>(level);
  const std::uint16_t* from = image.texels.data() + 4 * image.level_offset.at(at - 1);
  std::uint16_t* to = image.texels.data() + 4 * image.level_offset.at(at);
  parallel_for(height, 16, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      const Covered rows = covered_texels(y, height, fine_height);
      for (int x = 0; x < width; ++x) {
        const Covered columns = covered_texels(x, width, fine_width);
        float sum[4] = {};
        for (int j = 0; j < rows.count; ++j) {
          for (int i = 0; i < columns.count; ++i) {
            const float weight =
                rows.weight.at(static_cast<std::size_t>(j)) * columns.weight.at(static_cast<std::size_t>(i));
            const std::uint16_t* texel =
                from + 4 * (static_cast<long>(rows.first + j) * fine_width + columns.first + i);
            for (int c = 0; c < 4; ++c) {
              sum[c] += weight * static_cast<float>(texel[c]);
            }
          }
        }
        for (int c = 0; c < 4; ++c) {
          to[4 * (static_cast<long>(y) * width + x) + c] = static_cast<std::uint16_t>(std::lrint(sum[c]));
        }
      }
    }
  });
}

void make_levels(OverlayImage& image) {
  for (int level = 1; level < image.level_count; ++level) {
    make_level(image, level);
  }
}

Error unreadable_overlay(const std::filesystem::path& path, const std::string& reason) {
  return {path.string(), "cannot be read: " + reason, "use an image that OpenImageIO can read (PNG, EXR, TIFF, JPEG)"};
}

//! Returns the coding of an image; the last of two or four channels is alpha, whatever its name.
LightCoding coding_of(const ImageShape& shape) {
  LightCoding coding = light_coding(shape);
  if (coding.alpha < 0 && (shape.channels == 2 || shape.channels == 4)) {
    coding.alpha = shape.channels - 1;
  }
  return coding;
}

//! Whether the colors of an image are multiplied by its alpha.
enum class AlphaUse { multiply, ignore };

//! Converts a pixel's light and alpha to 16 bits.
void put_pixel(const LightCoding& coding, AlphaUse use, const float* from, std::uint16_t* to) {
  float light[3];
  LightCoding color = coding;
  if (use == AlphaUse::ignore && coding.separate) {
    color.alpha = -1;
  }
  color.put_light(from, light);
  std::ranges::transform(light, to, whole_number);
  to[3] = whole_number(coding.alpha_of(from));
}

const ImageLibrary::Wishes upright = {
    .bytes = std::nullopt, .separate_alpha = true, .as_stored = false, .as_light = true};
const ImageLibrary::Wishes as_stored = {.bytes = std::nullopt, .separate_alpha = true, .as_stored = true};

std::unique_ptr<ImageInput> opened_overlay(const std::filesystem::path& path, const ImageLibrary::Wishes& wishes) {
  std::string problem;
  auto input = image_library().open(path.string(), wishes, problem);
  if (!input) {
    throw unreadable_overlay(path, problem);
  }
  const ImageShape& shape = input->shape();
  if (shape.width < 1 || shape.height < 1 || shape.depth > 1 || shape.channels < 1 || shape.channels > 64) {
    throw unreadable_overlay(path, fmt::format("{} x {} pixels with {} channels are not supported", shape.width,
                                               shape.height, shape.channels));
  }
  if (shape.width > longest_overlay_px || shape.height > longest_overlay_px) {
    throw Error(path.string(), fmt::format("is {} x {} pixels, too large", shape.width, shape.height),
                fmt::format("scale it to at most {} px a side", longest_overlay_px));
  }
  return input;
}

OverlayImage read_opened_overlay(ImageInput& input, const std::filesystem::path& path, AlphaUse use) {
  const ImageShape shape = input.shape();
  const LightCoding coding = coding_of(shape);
  OverlayImage image;
  const std::size_t texels = lay_out(image, shape.width, shape.height);
  // Only reserves the memory, without touching it: a truncated file must not take the memory that
  // its header claims.
  image.texels.reserve(texels);
  const auto width = static_cast<std::size_t>(shape.width);
  const auto channels = static_cast<std::size_t>(coding.channels);
  const int max_rows = std::min(rows_at_a_time, shape.height);
  std::vector<float> rows(static_cast<std::size_t>(max_rows) * width * channels);
  for (int row = 0; row < shape.height; row += max_rows) {
    throw_if_reading_stopped(path.string());
    const int count = std::min(max_rows, shape.height - row);
    if (!input.read_rows(row, row + count, coding.channels, rows.data())) {
      throw Error(path.string(), "cannot be read: " + input.error(), "the file is truncated or damaged; save it again");
    }
    const std::size_t begin = 4 * width * static_cast<std::size_t>(row);
    image.texels.resize(std::max(image.texels.size(), begin + 4 * width * static_cast<std::size_t>(count)));
    std::uint16_t* to = image.texels.data() + begin;
    for (std::size_t i = 0; i < width * static_cast<std::size_t>(count); ++i) {
      put_pixel(coding, use, rows.data() + channels * i, to + 4 * i);
    }
  }
  image.texels.resize(texels);
  make_levels(image);
  return image;
}

}  // namespace

OverlayTexture OverlayImage::view(const std::uint16_t* at) const {
  OverlayTexture texture{at, {}, width, height, level_count};
  std::ranges::copy(level_offset, texture.level_offset);
  return texture;
}

long overlay_image_bytes(int width, int height) {
  long texels = 0;
  for (int level = 0; level == 0 || level_size(width, level - 1) > 1 || level_size(height, level - 1) > 1; ++level) {
    texels += static_cast<long>(level_size(width, level)) * level_size(height, level);
  }
  return texels * 4 * static_cast<long>(sizeof(std::uint16_t));
}

OverlayImage make_overlay_image(int width, int height, const std::vector<float>& rgba) {
  OverlayImage image = empty_image(width, height);
  std::transform(rgba.begin(), rgba.begin() + 4L * width * height, image.texels.begin(), whole_number);
  make_levels(image);
  return image;
}

OverlaySize overlay_image_size(const std::filesystem::path& path) {
  const auto input = opened_overlay(path, upright);
  return {input->shape().width, input->shape().height};
}

OverlayImage read_overlay_image(const std::filesystem::path& path) {
  const auto input = opened_overlay(path, upright);
  return read_opened_overlay(*input, path, AlphaUse::multiply);
}

OverlayImage read_stored_image(const std::filesystem::path& path) {
  const auto input = opened_overlay(path, as_stored);
  return read_opened_overlay(*input, path, AlphaUse::ignore);
}

OverlayImage read_stored_image(std::string_view bytes, const std::string& name) {
  ImageLibrary::Wishes wishes = as_stored;
  wishes.bytes = std::as_bytes(std::span(bytes));
  const auto input = opened_overlay(name, wishes);
  return read_opened_overlay(*input, name, AlphaUse::ignore);
}

}  // namespace ergodome
