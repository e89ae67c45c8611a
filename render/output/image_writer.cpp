#include "render/output/image_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <numeric>
#include <optional>
#include <span>
#include <string_view>

#include "content/files/atomic_file.h"
#include "content/images/image_library.h"
#include "content/images/plain/png_file.h"
#include "kernels/core/error.h"
#include "render/output/file_checksum.h"
#include "render/output/tone_map.h"

namespace ergodome {

namespace {

//! CIE 1931 chromaticities of Rec. 709: red, green, blue, D65 white.
constexpr float rec709[8] = {0.64F, 0.33F, 0.30F, 0.60F, 0.15F, 0.06F, 0.3127F, 0.3290F};

//! Prefix of metadata names in files.
const std::string metadata_prefix = "ergodome:";

//! Returns the picture's light, three values per pixel, clamped to 0 ... 65504 (the maximum of half
//! floats); NaN becomes 0.
std::vector<float> bounded_rgb(const Picture& picture) {
  std::vector<float> rgb;
  rgb.reserve(picture.rgba.size() / 4 * 3);
  for (std::size_t i = 0; i < picture.rgba.size(); ++i) {
    if (i % 4 != 3) {
      const float light = picture.rgba[i];
      rgb.push_back(light > 0.0F ? std::min(light, 65504.0F) : 0.0F);
    }
  }
  return rgb;
}

const char* plugin_of(ImageFormat format) {
  return format == ImageFormat::exr ? "openexr" : format == ImageFormat::tiff ? "tiff" : "png";
}

ImageSample sample_of(ImageFormat format) {
  switch (format) {
    case ImageFormat::exr:
      return ImageSample::half;
    case ImageFormat::png:
      return ImageSample::whole_8;
    default:
      return ImageSample::whole_16;
  }
}

std::vector<std::pair<std::string, std::string>> texts_of(const FrameMetadata& metadata) {
  std::vector<std::pair<std::string, std::string>> texts;
  for (const auto& [name, value] : metadata) {
    texts.emplace_back(metadata_prefix + name, value);
  }
  return texts;
}

ImagePlan make_plan(const FrameFormat& format, const Picture& picture, const FrameMetadata& metadata) {
  ImagePlan plan;
  plan.width = picture.width;
  plan.height = picture.height;
  plan.channels = format.alpha ? 4 : 3;
  plan.sample = sample_of(format.image);
  plan.texts = texts_of(metadata);
  plan.texts.emplace_back("Software", "Ergodome " ERGODOME_VERSION);
  if (format.image == ImageFormat::exr) {
    plan.texts.emplace_back("compression", exr_compression_names()[static_cast<std::size_t>(format.compression)]);
    plan.texts.emplace_back("oiio:ColorSpace", "Linear");
    plan.chromaticities.assign(std::begin(rec709), std::end(rec709));
    if (format.rate) {
      const std::int64_t common = std::gcd(format.rate->frames, format.rate->seconds);
      plan.ratios.push_back(
          {"FramesPerSecond",
           {static_cast<int>(format.rate->frames / common), static_cast<int>(format.rate->seconds / common)}});
    }
    return plan;
  }
  plan.texts.emplace_back("oiio:ColorSpace", "sRGB");
  if (format.alpha) {
    plan.numbers.emplace_back("oiio:UnassociatedAlpha", 1);
  }
  if (format.image == ImageFormat::tiff) {
    plan.texts.emplace_back("compression", "zip");
    // TIFF has no custom metadata, so all metadata are stored in its description.
    std::string description;
    for (const auto& [name, value] : metadata) {
      description.append(name).append("=").append(value).append("\n");
    }
    plan.texts.emplace_back("ImageDescription", description);
  } else {
    plan.numbers.emplace_back("png:compressionLevel", 4);
  }
  return plan;
}

//! Returns the values of a picture for a file: three per pixel, or four with the coverage if the
//! format has an alpha channel.
template <class Value>
std::vector<Value> with_alpha(const std::vector<Value>& rgb, const FrameFormat& format, const Picture& picture,
                              float maximum) {
  if (!format.alpha) {
    return rgb;
  }
  const std::vector<float> coverage = coverage_of(picture);
  std::vector<Value> rgba;
  rgba.reserve(rgb.size() / 3 * 4);
  for (std::size_t i = 0; i < coverage.size(); ++i) {
    rgba.insert(rgba.end(), rgb.begin() + static_cast<std::ptrdiff_t>(3 * i),
                rgb.begin() + static_cast<std::ptrdiff_t>(3 * i + 3));
    rgba.push_back(static_cast<Value>(maximum * coverage[i] + (maximum > 1.0F ? 0.5F : 0.0F)));
  }
  return rgba;
}

//! Divides the light of partly covered pixels by their coverage, because PNG and TIFF files get
//! straight alpha.
Picture light_beside_alpha(Picture picture) {
  for (std::size_t at = 0; at < picture.rgba.size(); at += 4) {
    const float coverage = picture.rgba[at + 3];
    for (std::size_t c = 0; c < 3 && coverage < 1.0F; ++c) {
      picture.rgba[at + c] = coverage > 0.0F ? picture.rgba[at + c] / coverage : 0.0F;
    }
  }
  return picture;
}

bool write_pixels(ImageOutput& output, const FrameFormat& format, const Picture& whole) {
  std::optional<Picture> beside;
  if (format.alpha && format.image != ImageFormat::exr) {
    beside = light_beside_alpha(whole);
  }
  const Picture& picture = beside ? *beside : whole;
  switch (format.image) {
    case ImageFormat::exr:
      return output.write(with_alpha(bounded_rgb(picture), format, picture, 1.0F).data());
    case ImageFormat::png:
      return output.write(with_alpha(tone_mapped(picture), format, picture, 255.0F).data());
    default:
      return output.write(with_alpha(tone_mapped_finely(picture), format, picture, 65535.0F).data());
  }
}

bool is_complete_part(ImageInput& input, int part, int width, int height) {
  return input.go_to_part(part) && input.shape().width == width && input.shape().height == height &&
         input.read_through();
}

//! Returns false for a PNG without its end marker, true for any other file. Avoids opening
//! truncated PNG files, for which the reader prints messages.
bool may_be_whole(const std::filesystem::path& path) {
  constexpr std::string_view end("IEND\xAE\x42\x60\x82", 8);
  if (path.extension() != ".png") {
    return true;
  }
  std::ifstream file(path, std::ios::binary);
  char last[8] = {};
  return file.seekg(-static_cast<std::streamoff>(sizeof last), std::ios::end) && file.read(last, sizeof last) &&
         std::string_view(last, sizeof last) == end;
}

//! Returns whether a file is an image of this size and number of parts that can be read to its last
//! pixel.
bool is_whole(const std::filesystem::path& path, int width, int height, int parts) {
  std::error_code problem;
  if (!std::filesystem::is_regular_file(path, problem) || !may_be_whole(path)) {
    return false;
  }
  if (const std::optional<bool> whole = is_whole_png(path.string(), width, height)) {
    return *whole && parts == 1;
  }
  std::string reason;
  const auto input = image_library().open(path.string(), {}, reason);
  if (!input) {
    return false;
  }
  for (int part = 0; part < parts; ++part) {
    if (!is_complete_part(*input, part, width, height)) {
      // Clears the message, so that later errors do not include it.
      static_cast<void>(input->error());
      return false;
    }
  }
  return true;
}

//! Returns whether a file's format cannot detect changed bytes itself.
bool needs_checksum(const std::filesystem::path& path) { return path.extension() != ".png"; }

Error cannot_be_written(const std::filesystem::path& path, ImageOutput* output) {
  // The library reports every failed row in a separate line, without the reason.
  const std::string message = output != nullptr ? output->error() : "";
  const std::string first = message.substr(0, message.find('\n'));
  const std::string reason = disk_is_full(path) ? "the disk is full"
                             : first.empty()    ? "the file system rejects it"
                                                : first;
  return {path.string(), "cannot be written: " + reason, "check the folder, its permissions and the free space"};
}

//! Creates a writer for an image in a format; nullptr if the image library cannot.
std::unique_ptr<ImageOutput> writer_of(std::string_view format, const ImagePlan& plan) {
  std::string problem;
  return format == "png" && is_for_png_output(plan) ? png_output()
                                                    : image_library().create(std::string(format), nullptr, problem);
}

}  // namespace

void write_picture(const std::filesystem::path& path, const FrameFormat& format, const Picture& picture,
                   const FrameMetadata& metadata) {
  write_atomically(path, [&](const std::filesystem::path& partial) {
    const ImagePlan plan[] = {make_plan(format, picture, metadata)};
    const auto output = writer_of(plugin_of(format.image), plan[0]);
    const bool written = output && output->open(partial.string(), plan) && write_pixels(*output, format, picture);
    // Closing flushes, so it can fail too.
    if (!written || !output->close() || !is_whole(partial, picture.width, picture.height, 1)) {
      throw cannot_be_written(path, output.get());
    }
    if (needs_checksum(path)) {
      append_checksum(partial);
    }
  });
}

void write_views(const std::filesystem::path& path, const FrameFormat& format, const Picture& left,
                 const Picture& right, const FrameMetadata& metadata) {
  ImagePlan plans[] = {make_plan(format, left, metadata), make_plan(format, right, metadata)};
  constexpr const char* views[] = {"left", "right"};
  const Picture* pictures[] = {&left, &right};
  for (int i = 0; i < 2; ++i) {
    plans[i].texts.emplace_back("oiio:subimagename", views[i]);
    plans[i].texts.emplace_back("view", views[i]);
  }
  write_atomically(path, [&](const std::filesystem::path& partial) {
    const auto output = writer_of("openexr", plans[0]);
    bool written = output && output->open(partial.string(), plans);
    for (int i = 0; i < 2 && written; ++i) {
      written =
          (i == 0 || output->open_next(partial.string(), plans[i])) && write_pixels(*output, format, *pictures[i]);
    }
    if (!written || !output->close() || !is_whole(partial, left.width, left.height, 2)) {
      throw cannot_be_written(path, output.get());
    }
    append_checksum(partial);
  });
}

void write_numbers(const std::filesystem::path& path, ExrCompression compression, const NumberImage& image,
                   const FrameMetadata& metadata) {
  ImagePlan plan;
  plan.width = image.width;
  plan.height = image.height;
  plan.channels = static_cast<int>(image.channels.size());
  plan.sample = ImageSample::real;
  plan.texts = texts_of(metadata);
  plan.texts.emplace_back("Software", "Ergodome " ERGODOME_VERSION);
  plan.texts.emplace_back("compression", exr_compression_names()[static_cast<std::size_t>(compression)]);
  plan.chromaticities.assign(std::begin(rec709), std::end(rec709));
  plan.channel_names = image.channels;
  write_atomically(path, [&](const std::filesystem::path& partial) {
    const auto output = writer_of("openexr", plan);
    const bool written =
        output && output->open(partial.string(), std::span(&plan, 1)) && output->write(image.values.data());
    if (!written || !output->close() || !is_whole(partial, image.width, image.height, 1)) {
      throw cannot_be_written(path, output.get());
    }
    append_checksum(partial);
  });
}

void write_png(const std::filesystem::path& path, const std::vector<std::uint8_t>& rgb, int width, int height,
               const FrameMetadata& metadata) {
  write_atomically(path, [&](const std::filesystem::path& partial) {
    const ImagePlan plan[] = {{width, height, 3, ImageSample::whole_8, texts_of(metadata), {}, {}}};
    const auto output = writer_of("png", plan[0]);
    const bool written = output && output->open(partial.string(), plan) && output->write(rgb.data()) && output->close();
    // The library does not report a full disk as an error, so the file is read again.
    if (!written || !is_whole(partial, width, height, 1)) {
      throw cannot_be_written(path, output.get());
    }
  });
}

bool is_complete_image(const std::filesystem::path& path, int width, int height, int parts) {
  return is_whole(path, width, height, parts) && (!needs_checksum(path) || has_right_checksum(path));
}

std::string metadata_of_image(const std::filesystem::path& path, const std::string& name) {
  std::error_code problem;
  std::string reason;
  const auto input = std::filesystem::is_regular_file(path, problem) && may_be_whole(path)
                         ? image_library().open(path.string(), {}, reason)
                         : nullptr;
  if (!input) {
    return {};
  }
  std::string own = input->text(metadata_prefix + name);
  if (!own.empty()) {
    return own;
  }
  // TIFF has all metadata in its description, one per line.
  const std::string description = fmt::format("\n{}", input->text("ImageDescription"));
  const std::string before = fmt::format("\n{}=", name);
  const std::size_t at = description.find(before);
  if (at == std::string::npos) {
    return {};
  }
  const std::size_t begin = at + before.size();
  return description.substr(begin, description.find('\n', begin) - begin);
}

}  // namespace ergodome
