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

OIIO::ImageSpec make_spec(ImageFormat format, const Picture& picture, const FrameMetadata& metadata) {
  OIIO::ImageSpec spec(picture.width, picture.height, 3,
                       format == ImageFormat::png ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::HALF);
  spec.attribute("Software", "Ergodome " ERGODOME_VERSION);
  for (const auto& [name, value] : metadata) {
    spec.attribute("ergodome:" + name, value);
  }
  if (format == ImageFormat::exr) {
    spec.attribute("compression", "zip");
    spec.attribute("oiio:ColorSpace", "Linear");
    spec.attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8), rec709);
  } else {
    spec.attribute("oiio:ColorSpace", "sRGB");
    spec.attribute("png:compressionLevel", 4);
  }
  return spec;
}

}  // namespace

void write_picture(const std::filesystem::path& path, ImageFormat format, const Picture& picture,
                   const FrameMetadata& metadata) {
  write_atomically(path, [&](const std::filesystem::path& partial) {
    const auto output = OIIO::ImageOutput::create(format == ImageFormat::png ? "png" : "exr");
    const bool opened = output && output->open(partial.string(), make_spec(format, picture, metadata));
    bool written = false;
    if (opened && format == ImageFormat::png) {
      written = output->write_image(OIIO::TypeDesc::UINT8, tone_mapped(picture).data());
    } else if (opened) {
      written = output->write_image(OIIO::TypeDesc::FLOAT, bounded_rgb(picture).data());
    }
    // Closing flushes, so it can fail too.
    if (!written || !output->close() || !is_complete_image(partial, picture.width, picture.height)) {
      const std::string reason =
          output && output->has_error() ? output->geterror() : "the folder or the disk refuses it";
      throw Error(path.string(), "cannot be written: " + reason,
                  "check the folder, its permissions and the space left");
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

bool is_complete_image(const std::filesystem::path& path, int width, int height) {
  std::error_code problem;
  if (!std::filesystem::is_regular_file(path, problem)) {
    return false;
  }
  const auto input = OIIO::ImageInput::open(path.string());
  if (!input) {
    static_cast<void>(OIIO::geterror());  // takes the message away, so that nobody else finds it
    return false;
  }
  const OIIO::ImageSpec& spec = input->spec();
  if (spec.width != width || spec.height != height) {
    return false;
  }
  std::vector<unsigned char> rows(spec.scanline_bytes(true) * 64);
  for (int y = 0; y < height; y += 64) {
    if (!input->read_scanlines(0, 0, spec.y + y, spec.y + std::min(y + 64, height), 0, 0, spec.nchannels,
                               OIIO::TypeDesc::UNKNOWN, rows.data())) {
      static_cast<void>(input->geterror());
      return false;
    }
  }
  return true;
}

}  // namespace ergodome
