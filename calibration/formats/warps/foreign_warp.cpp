#include "calibration/formats/warps/foreign_warp.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "calibration/formats/warps/warp_text.h"
#include "content/files/printable.h"
#include "content/files/whole_file.h"

namespace ergodome {

namespace {

constexpr std::size_t max_warp_bytes = std::size_t{1} << 30U;
//! Maximum coordinate or angle; far outside any raster or image.
constexpr double largest_warp_number = 1e4;

}  // namespace

std::string shown_of(std::string_view text) { return printable(text.substr(0, 40)); }

std::string WarpText::location() const { return fmt::format("{}:{}", file_, std::max(lines_.number(), 1)); }

double WarpText::number(std::string_view word, std::string_view what) const {
  const auto value = decimal_of(word);
  if (!value) {
    throw error(word.empty() ? fmt::format("{} is missing", what) : fmt::format("{} is \"{}\"", what, shown_of(word)),
                "write a number");
  }
  if (!(std::abs(*value) <= largest_warp_number)) {
    throw error(fmt::format("{} is {}", what, shown_of(word)), "write a finite number from -10,000 to 10,000");
  }
  return *value;
}

long long WarpText::whole(std::string_view word, std::string_view what, long long minimum, long long maximum) const {
  const auto value = whole_number_of(word);
  if (!value || *value < minimum || *value > maximum) {
    throw error(word.empty() ? fmt::format("{} is missing", what) : fmt::format("{} is \"{}\"", what, shown_of(word)),
                fmt::format("write a whole number from {} to {}", minimum, maximum));
  }
  return *value;
}

void check_view(const Frustum& frustum, const std::string& location) {
  constexpr double widest_deg = 89.9;
  const auto [minimum, maximum] = std::minmax({frustum.left_deg, frustum.right_deg, frustum.up_deg, frustum.down_deg});
  const bool ordered = frustum.left_deg < frustum.right_deg && frustum.down_deg < frustum.up_deg;
  if (!(minimum >= -widest_deg && maximum <= widest_deg) || !ordered) {
    throw Error(
        location,
        fmt::format("has an impossible field of view: {:g}° (left) to {:g}° (right) and {:g}° (down) to {:g}° (up)",
                    frustum.left_deg, frustum.right_deg, frustum.down_deg, frustum.up_deg),
        "choose angles with left < right and down < up, all less than 90° from the middle");
  }
}

std::string words_of(const WarpView& view) {
  // Rounds to hundredths; adding 0 turns -0 into 0.
  const auto shown_deg = [](double angle_deg) { return std::round(100.0 * angle_deg) / 100.0 + 0.0; };
  const auto& [orientation, frustum] = view;
  return fmt::format(
      "yaw {:.2f}°, pitch {:.2f}°, roll {:.2f}°, {:.2f}° to {:.2f}° horizontally and {:.2f}° to {:.2f}° vertically",
      shown_deg(orientation.yaw_deg), shown_deg(orientation.pitch_deg), shown_deg(orientation.roll_deg),
      shown_deg(frustum.left_deg), shown_deg(frustum.right_deg), shown_deg(frustum.down_deg),
      shown_deg(frustum.up_deg));
}

bool is_foreign(WarpFormat format) {
  return format != WarpFormat::bourke && format != WarpFormat::pfm && format != WarpFormat::mpcdi;
}

ForeignWarp parse_foreign_warp(std::string_view bytes, const std::string& file, WarpFormat format) {
  if (bytes.starts_with("\xff\xfe") || bytes.starts_with("\xfe\xff")) {
    throw Error(file, "is text in UTF-16", "save it as UTF-8 or plain ASCII");
  }
  const bool is_binary = bytes.substr(0, warp_head_bytes).find('\0') != std::string_view::npos;
  if (is_binary && format != WarpFormat::sciss) {
    throw Error(file, fmt::format("is a binary file, not {}", name_of(format)),
                "name another file, or write its format");
  }
  const auto found = format_of_content(bytes);
  if (found && *found != format) {
    throw Error(file, fmt::format("is {}, not {}", name_of(*found), name_of(format)),
                fmt::format("write format = \"{}\"", word_of(*found)));
  }
  switch (format) {
    case WarpFormat::domeprojection:
      return parse_domeprojection_warp(bytes, file);
    case WarpFormat::obj:
      return parse_obj_warp(bytes, file);
    case WarpFormat::sciss:
      return parse_sciss_warp(bytes, file);
    case WarpFormat::easyblend:
      return parse_easyblend_warp(bytes, file);
    case WarpFormat::simcad:
      return parse_simcad_warp(bytes, file);
    case WarpFormat::skyskan:
      return parse_skyskan_warp(bytes, file);
    case WarpFormat::bourke:
    case WarpFormat::pfm:
    case WarpFormat::mpcdi:
      break;
  }
  throw Error(file, fmt::format("is {}", name_of(format)), "write the format of the file");
}

ForeignWarp read_foreign_warp(const std::filesystem::path& path, WarpFormat format) {
  return parse_foreign_warp(read_whole_file(path, max_warp_bytes, fmt::format("give {}", name_of(format))),
                            path.string(), format);
}

}  // namespace ergodome
