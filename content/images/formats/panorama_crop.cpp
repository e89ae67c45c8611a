#include "content/images/formats/panorama_crop.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <pugixml.hpp>

#include "content/images/formats/shown_layout.h"

namespace ergodome {

namespace {

//! Returns a property of an XMP description, which is an attribute or a child element.
std::string property(const pugi::xml_node& description, const char* name) {
  const std::string full_name = std::string("GPano:") + name;
  if (const pugi::xml_attribute attribute = description.attribute(full_name.c_str())) {
    return attribute.as_string();
  }
  return description.child(full_name.c_str()).text().as_string();
}

int pixels(const pugi::xml_node& description, const char* name) {
  constexpr double maximum = 1'000'000.0;
  const std::string text = property(description, name);
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  return end != text.c_str() && number >= 0.0 && number <= maximum ? static_cast<int>(std::lround(number)) : -1;
}

}  // namespace

void place_crop(const PanoramaCrop& crop, ShownLayout& layout) {
  const double scale = static_cast<double>(layout.data_width) / crop.width;
  const auto scaled = [&](int value) { return std::lround(scale * value); };
  layout.window_height = static_cast<int>(scaled(crop.full_height));
  // A panorama whose width is exactly twice its height keeps that ratio, whatever the rounding.
  layout.window_width =
      static_cast<int>(crop.full_width == 2 * crop.full_height ? 2L * layout.window_height : scaled(crop.full_width));
  layout.data_left = scaled(crop.left);
  layout.data_top = scaled(crop.top);
}

PanoramaCrop read_panorama_crop(std::string_view bytes) {
  constexpr std::string_view begin_mark = "<x:xmpmeta";
  constexpr std::string_view end_mark = "</x:xmpmeta>";
  PanoramaCrop crop;
  const std::size_t begin = bytes.find(begin_mark);
  const std::size_t end = begin == std::string_view::npos ? begin : bytes.find(end_mark, begin);
  if (end == std::string_view::npos) {
    return crop;
  }
  pugi::xml_document packet;
  if (!packet.load_buffer(bytes.data() + begin, end + end_mark.size() - begin)) {
    return crop;
  }
  for (const pugi::xml_node& description : packet.child("x:xmpmeta").child("rdf:RDF").children("rdf:Description")) {
    const std::string projection = property(description, "ProjectionType");
    const int full_width = pixels(description, "FullPanoWidthPixels");
    if (projection.empty() && full_width < 0) {
      continue;
    }
    if (!projection.empty() && projection != "equirectangular") {
      crop.problem = fmt::format("its panorama is {}, not equirectangular", projection);
      return crop;
    }
    crop = {full_width,
            pixels(description, "FullPanoHeightPixels"),
            pixels(description, "CroppedAreaLeftPixels"),
            pixels(description, "CroppedAreaTopPixels"),
            pixels(description, "CroppedAreaImageWidthPixels"),
            pixels(description, "CroppedAreaImageHeightPixels"),
            ""};
    // A panorama counts as uncropped if one of these properties is missing or invalid.
    if (crop.full_width < 1 || crop.full_height < 1 || crop.left < 0 || crop.top < 0 || crop.width < 1 ||
        crop.height < 1) {
      crop = {};
    }
    return crop;
  }
  return crop;
}

}  // namespace ergodome
