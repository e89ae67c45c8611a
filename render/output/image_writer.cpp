#include "render/output/image_writer.h"

#include <algorithm>

#include "content/files/atomic_file.h"
#include "content/images/image_library.h"
#include "kernels/core/error.h"
#include "render/output/tone_map.h"

namespace ergodome {

namespace {

//! CIE 1931 chromaticities of Rec. 709: red, green, blue, D65 white.
constexpr float rec709[8] = {0.64F, 0.33F, 0.30F, 0.60F, 0.15F, 0.06F, 0.3127F, 0.3290F};

//! Finite, and within what a half float can hold.
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

ImagePlan make_plan(const FrameFormat& format, const Picture& picture, const FrameMetadata& metadata) {
  constexpr const char* compressions[] = {"zip", "none", "dwaa"};
  ImagePlan plan;
  plan.width = picture.width;
  plan.height = picture.height;
  plan.channels = format.alpha ? 4 : 3;
  plan.sample = sample_of(format.image);
  plan.texts.emplace_back("Software", "Ergodome " ERGODOME_VERSION);
  for (const auto& [name, value] : metadata) {
    plan.texts.emplace_back("ergodome:" + name, value);
  }
  if (format.image == ImageFormat::exr) {
    plan.texts.emplace_back("compression", compressions[static_cast<int>(format.compression)]);
    plan.texts.emplace_back("oiio:ColorSpace", "Linear");
    plan.chromaticities.assign(std::begin(rec709), std::end(rec709));
    return plan;
  }
  plan.texts.emplace_back("oiio:ColorSpace", "sRGB");
  if (format.image == ImageFormat::tiff) {
    plan.texts.emplace_back("compression", "zip");
    // TIFF has no place for facts of others: they stand in its description.
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

//! Rows of a picture for a file, with the coverage where there is an alpha channel.
template <class Value>
std::vector<Value> with_alpha(const std::vector<Value>& rgb, const FrameFormat& format, const Picture& picture,
                              float most) {
  if (!format.alpha) {
    return rgb;
  }
  const std::vector<float> coverage = coverage_of(picture);
  std::vector<Value> rgba;
  rgba.reserve(rgb.size() / 3 * 4);
  for (std::size_t i = 0; i < coverage.size(); ++i) {
    rgba.insert(rgba.end(), rgb.begin() + static_cast<std::ptrdiff_t>(3 * i),
                rgb.begin() + static_cast<std::ptrdiff_t>(3 * i + 3));
    rgba.push_back(static_cast<Value>(most * coverage[i] + (most > 1.0F ? 0.5F : 0.0F)));
  }
  return rgba;
}

bool write_pixels(ImageOutput& output, const FrameFormat& format, const Picture& picture) {
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

Error cannot_be_written(const std::filesystem::path& path, ImageOutput* output) {
  const std::string reason = output != nullptr ? output->error() : "";
  return {path.string(), "cannot be written: " + (reason.empty() ? "the folder or the disk refuses it" : reason),
          "check the folder, its permissions and the space left"};
}

//! A writer of a format that the program counts on.
std::unique_ptr<ImageOutput> writer_of(const char* format) {
  std::string problem;
  return image_library().create(format, nullptr, problem);
}

}  // namespace

void write_picture(const std::filesystem::path& path, const FrameFormat& format, const Picture& picture,
                   const FrameMetadata& metadata) {
  write_atomically(path, [&](const std::filesystem::path& partial) {
    const auto output = writer_of(plugin_of(format.image));
    const ImagePlan plan[] = {make_plan(format, picture, metadata)};
    const bool written = output && output->open(partial.string(), plan) && write_pixels(*output, format, picture);
    // Closing flushes, so it can fail too.
    if (!written || !output->close() || !is_complete_image(partial, picture.width, picture.height)) {
      throw cannot_be_written(path, output.get());
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
    const auto output = writer_of("openexr");
    bool written = output && output->open(partial.string(), plans);
    for (int i = 0; i < 2 && written; ++i) {
      written =
          (i == 0 || output->open_next(partial.string(), plans[i])) && write_pixels(*output, format, *pictures[i]);
    }
    if (!written || !output->close() || !is_complete_image(partial, left.width, left.height, 2)) {
      throw cannot_be_written(path, output.get());
    }
  });
}

void write_png(const std::filesystem::path& path, const std::vector<std::uint8_t>& rgb, int width, int height) {
  write_atomically(path, [&](const std::filesystem::path& partial) {
    const auto output = writer_of("png");
    const ImagePlan plan[] = {{width, height, 3, ImageSample::whole_8, {}, {}, {}}};
    const bool written = output && output->open(partial.string(), plan) && output->write(rgb.data()) && output->close();
    if (!written) {
      throw Error(path.string(), "cannot be written", "check the folder, its permissions and the space left");
    }
  });
}

bool is_complete_image(const std::filesystem::path& path, int width, int height, int parts) {
  std::error_code problem;
  if (!std::filesystem::is_regular_file(path, problem)) {
    return false;
  }
  std::string reason;
  const auto input = image_library().open(path.string(), {}, reason);
  if (!input) {
    return false;
  }
  for (int part = 0; part < parts; ++part) {
    if (!is_complete_part(*input, part, width, height)) {
      static_cast<void>(input->error());  // takes the message away, so that nobody else finds it
      return false;
    }
  }
  return true;
}

}  // namespace ergodome
