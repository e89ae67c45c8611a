#include "render/output/image_writer.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>

#include "content/files/atomic_file.h"
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

OIIO::TypeDesc type_of(ImageFormat format) {
  switch (format) {
    case ImageFormat::exr:
      return OIIO::TypeDesc::HALF;
    case ImageFormat::png:
      return OIIO::TypeDesc::UINT8;
    default:
      return OIIO::TypeDesc::UINT16;
  }
}

OIIO::ImageSpec make_spec(const FrameFormat& format, const Picture& picture, const FrameMetadata& metadata) {
  constexpr const char* compressions[] = {"zip", "none", "dwaa"};
  OIIO::ImageSpec spec(picture.width, picture.height, format.alpha ? 4 : 3, type_of(format.image));
  spec.attribute("Software", "Ergodome " ERGODOME_VERSION);
  for (const auto& [name, value] : metadata) {
    spec.attribute("ergodome:" + name, value);
  }
  if (format.image == ImageFormat::exr) {
    spec.attribute("compression", compressions[static_cast<int>(format.compression)]);
    spec.attribute("oiio:ColorSpace", "Linear");
    spec.attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8), rec709);
    return spec;
  }
  spec.attribute("oiio:ColorSpace", "sRGB");
  if (format.image == ImageFormat::tiff) {
    spec.attribute("compression", "zip");
    // TIFF has no place for facts of others: they stand in its description.
    std::string description;
    for (const auto& [name, value] : metadata) {
      description.append(name).append("=").append(value).append("\n");
    }
    spec.attribute("ImageDescription", description);
  } else {
    spec.attribute("png:compressionLevel", 4);
  }
  return spec;
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

bool write_pixels(OIIO::ImageOutput& output, const FrameFormat& format, const Picture& picture) {
  switch (format.image) {
    case ImageFormat::exr:
      return output.write_image(OIIO::TypeDesc::FLOAT, with_alpha(bounded_rgb(picture), format, picture, 1.0F).data());
    case ImageFormat::png:
      return output.write_image(OIIO::TypeDesc::UINT8,
                                with_alpha(tone_mapped(picture), format, picture, 255.0F).data());
    default:
      return output.write_image(OIIO::TypeDesc::UINT16,
                                with_alpha(tone_mapped_finely(picture), format, picture, 65535.0F).data());
  }
}

bool is_complete_part(OIIO::ImageInput& input, int part, int width, int height) {
  if (!input.seek_subimage(part, 0)) {
    return false;
  }
  const OIIO::ImageSpec& spec = input.spec();
  if (spec.width != width || spec.height != height) {
    return false;
  }
  std::vector<unsigned char> rows(spec.scanline_bytes(true) * 64);
  for (int y = 0; y < height; y += 64) {
    if (!input.read_scanlines(part, 0, spec.y + y, spec.y + std::min(y + 64, height), 0, 0, spec.nchannels,
                              OIIO::TypeDesc::UNKNOWN, rows.data())) {
      return false;
    }
  }
  return true;
}

Error cannot_be_written(const std::filesystem::path& path, const OIIO::ImageOutput* output) {
  const std::string reason =
      output != nullptr && output->has_error() ? output->geterror() : "the folder or the disk refuses it";
  return {path.string(), "cannot be written: " + reason, "check the folder, its permissions and the space left"};
}

}  // namespace

void write_picture(const std::filesystem::path& path, const FrameFormat& format, const Picture& picture,
                   const FrameMetadata& metadata) {
  write_atomically(path, [&](const std::filesystem::path& partial) {
    const auto output = OIIO::ImageOutput::create(plugin_of(format.image));
    const bool written = output && output->open(partial.string(), make_spec(format, picture, metadata)) &&
                         write_pixels(*output, format, picture);
    // Closing flushes, so it can fail too.
    if (!written || !output->close() || !is_complete_image(partial, picture.width, picture.height)) {
      throw cannot_be_written(path, output.get());
    }
  });
}

void write_views(const std::filesystem::path& path, const FrameFormat& format, const Picture& left,
                 const Picture& right, const FrameMetadata& metadata) {
  OIIO::ImageSpec specs[] = {make_spec(format, left, metadata), make_spec(format, right, metadata)};
  constexpr const char* views[] = {"left", "right"};
  const Picture* pictures[] = {&left, &right};
  for (int i = 0; i < 2; ++i) {
    specs[i].attribute("oiio:subimagename", views[i]);
    specs[i].attribute("view", views[i]);
  }
  write_atomically(path, [&](const std::filesystem::path& partial) {
    const auto output = OIIO::ImageOutput::create("exr");
    bool written = output && output->open(partial.string(), 2, specs);
    for (int i = 0; i < 2 && written; ++i) {
      written = (i == 0 || output->open(partial.string(), specs[i], OIIO::ImageOutput::AppendSubimage)) &&
                write_pixels(*output, format, *pictures[i]);
    }
    if (!written || !output->close() || !is_complete_image(partial, left.width, left.height, 2)) {
      throw cannot_be_written(path, output.get());
    }
  });
}

void write_png(const std::filesystem::path& path, const std::vector<std::uint8_t>& rgb, int width, int height) {
  write_atomically(path, [&](const std::filesystem::path& partial) {
    const auto output = OIIO::ImageOutput::create("png");
    const bool written = output &&
                         output->open(partial.string(), OIIO::ImageSpec(width, height, 3, OIIO::TypeDesc::UINT8)) &&
                         output->write_image(OIIO::TypeDesc::UINT8, rgb.data()) && output->close();
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
  const auto input = OIIO::ImageInput::open(path.string());
  if (!input) {
    static_cast<void>(OIIO::geterror());  // takes the message away, so that nobody else finds it
    return false;
  }
  for (int part = 0; part < parts; ++part) {
    if (!is_complete_part(*input, part, width, height)) {
      static_cast<void>(input->geterror());
      return false;
    }
  }
  return true;
}

}  // namespace ergodome
