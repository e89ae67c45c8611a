#include "content/images/module/shown_pixels.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace ergodome {

namespace {

template <class Number>
bool read_numbers_in_place(OIIO::ImageInput& input, const StoredPixels& stored, const ShownLayout& layout,
                           OIIO::TypeDesc type, std::vector<Number>& shown) {
  const auto [part, first_channel, channels] = stored;
  const int last_channel = first_channel + channels;
  const OIIO::ImageSpec spec = input.spec();
  const auto numbers = static_cast<std::size_t>(channels);
  // Tiled images are read one row of tiles at a time.
  const bool tiled = spec.tile_width > 0;
  const int rows_at_once = std::min(spec.height, tiled ? spec.tile_height : 64);
  std::vector<Number> rows(numbers * static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(rows_at_once));
  for (int begin = 0; begin < spec.height; begin += rows_at_once) {
    const int end = std::min(begin + rows_at_once, spec.height);
    const bool read = tiled
                          ? input.read_tiles(part, 0, spec.x, spec.x + spec.width, spec.y + begin, spec.y + end, spec.z,
                                             spec.z + spec.depth, first_channel, last_channel, type, rows.data())
                          : input.read_scanlines(part, 0, spec.y + begin, spec.y + end, 0, first_channel, last_channel,
                                                 type, rows.data());
    if (!read) {
      return false;
    }
    if (begin == 0) {
      // The image is allocated only after the first read: a damaged file may claim any size.
      shown.assign(numbers * static_cast<std::size_t>(layout.width()) * static_cast<std::size_t>(layout.height()),
                   Number{});
    }
    put_rows(layout, begin, end, channels, rows.data(), shown.data());
  }
  return true;
}

//! Returns the part of a TIFF's orientation that OpenImageIO has not applied itself. OpenImageIO
//! reads YCbCr, CIELAB and JPEG-compressed gray through libtiff's RGBA interface, which applies
//! mirroring, but does not exchange rows and columns.
int left_of_tiff_orientation(const OIIO::ImageSpec& spec, int orientation) {
  const int photometric = spec.get_int_attribute("tiff:PhotometricInterpretation", 2);
  const bool grey_jpeg = photometric <= 1 && spec.get_string_attribute("compression") == "jpeg";
  const bool mirrored_already = grey_jpeg || (photometric >= 6 && photometric <= 10);
  constexpr std::array<int, 9> left = {1, 1, 1, 1, 1, 5, 7, 5, 7};
  return mirrored_already ? left.at(static_cast<std::size_t>(orientation)) : orientation;
}

//! Converts OpenImageIO's orientation of a Radiance file to Exif: OpenImageIO exchanges 6 ("+X +Y")
//! and 8 ("-X -Y").
int exif_of_radiance_orientation(int orientation) { return orientation == 6 ? 8 : orientation == 8 ? 6 : orientation; }

}  // namespace

ShownLayout shown_layout(const OIIO::ImageInput& input) {
  const OIIO::ImageSpec& spec = input.spec();
  ShownLayout layout;
  layout.data_width = layout.window_width = spec.width;
  layout.data_height = layout.window_height = spec.height;
  // In other formats, these attributes are the position of an image on a page, sometimes in inches.
  if (std::string_view(input.format_name()) == "openexr") {
    layout.data_left = static_cast<long>(spec.x) - spec.full_x;
    layout.data_top = static_cast<long>(spec.y) - spec.full_y;
    layout.window_width = spec.full_width;
    layout.window_height = spec.full_height;
  }
  // For a cube map, OpenImageIO reports a single face as the window; the window is then set to all
  // pixels.
  if (spec.get_string_attribute("textureformat") == "CubeFace Environment") {
    layout.data_left = layout.data_top = 0;
    layout.window_width = spec.width;
    layout.window_height = spec.height;
  }
  const std::string_view format = input.format_name();
  const int stored = spec.get_int_attribute("Orientation", 1);
  const int orientation = stored >= 1 && stored <= 8 ? stored : 1;
  layout.orientation = format == "tiff"  ? left_of_tiff_orientation(spec, orientation)
                       : format == "hdr" ? exif_of_radiance_orientation(orientation)
                                         : orientation;
  return layout;
}

bool read_in_place(OIIO::ImageInput& input, const StoredPixels& stored, const ShownLayout& layout,
                   std::vector<float>& shown) {
  return read_numbers_in_place(input, stored, layout, OIIO::TypeDesc::FLOAT, shown);
}

bool read_in_place(OIIO::ImageInput& input, const StoredPixels& stored, const ShownLayout& layout,
                   std::vector<std::uint16_t>& shown) {
  return read_numbers_in_place(input, stored, layout, OIIO::TypeDesc::UINT16, shown);
}

}  // namespace ergodome
