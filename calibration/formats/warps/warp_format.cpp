#include "calibration/formats/warps/warp_format.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <initializer_list>
#include <iterator>

#include "calibration/warps/text_lines.h"

namespace ergodome {

namespace {

struct WarpFormatNames {
  const char* word;
  const char* name;
  std::initializer_list<std::string_view> endings;
};

//! Properties of the formats, in the order of WarpFormat.
const WarpFormatNames format_names[] = {
    {"bourke", "a mesh in Paul Bourke's format", {".data"}},
    {"pfm", "a portable float map", {".pfm"}},
    {"mpcdi", "an MPCDI calibration", {".mpcdi", ".xml"}},
    {"domeprojection", "a domeprojection warp", {".csv"}},
    {"obj", "a Wavefront OBJ mesh", {".obj"}},
    {"sciss", "a SCISS warp", {".sgc"}},
    {"easyblend", "an EasyBlend mesh", {".ol"}},
    {"simcad", "a SimCAD warp", {".simcad"}},
    {"skyskan", "a Sky-Skan warp", {".txt"}},
};

std::string in_small_letters(std::string_view text) {
  std::string small(text);
  std::ranges::transform(small, small.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return small;
}

std::optional<WarpFormat> format_of_xml(std::string_view head) {
  const std::string small = in_small_letters(head);
  const std::size_t simcad = small.find("<geometryfile");
  const std::size_t mpcdi = small.find("<mpcdi");
  if (simcad == mpcdi) {
    return std::nullopt;
  }
  return simcad < mpcdi ? WarpFormat::simcad : WarpFormat::mpcdi;
}

bool is_sky_skan_line(const std::string& small) {
  constexpr std::string_view keys[] = {"dome azimuth=",     "dome elevation=", "horizontal fov=", "vertical fov=",
                                       "horizontal tweak=", "vertical tweak=", "u tweak=",        "v tweak="};
  return std::ranges::any_of(keys, [&](std::string_view key) { return small.starts_with(key); });
}

bool is_obj_line(std::string_view line) {
  std::string_view rest = line;
  const std::string_view word = take_word(rest);
  if (word == "v" || word == "vt" || word == "vn") {
    return decimal_of(take_word(rest)).has_value();
  }
  return word == "mtllib" || word == "usemtl" || ((word == "o" || word == "g") && !take_word(rest).empty());
}

//! Returns true if a line names domeprojection's columns, or is a node in a file without that
//! header: six numbers separated by semicolons.
bool is_domeprojection_line(const std::string& small) {
  return small.starts_with("x;y;u;v;col") || small.starts_with("x,y,u,v,col") || small.starts_with("x\ty\tu\tv\tcol") ||
         (std::ranges::count(small, ';') == 5 && std::ranges::all_of(small, [](unsigned char c) {
            return std::isdigit(c) != 0 ||
                   std::string_view(".,;+-e \t").find(static_cast<char>(c)) != std::string_view::npos;
          }));
}

}  // namespace

const char* word_of(WarpFormat format) { return format_names[static_cast<int>(format)].word; }

const char* name_of(WarpFormat format) { return format_names[static_cast<int>(format)].name; }

std::optional<WarpFormat> format_of_content(std::string_view head) {
  head = head.substr(0, warp_head_bytes);
  if (head.starts_with("PF") || head.starts_with("Pf")) {
    return WarpFormat::pfm;
  }
  if (head.starts_with("PK\x03\x04")) {
    return WarpFormat::mpcdi;
  }
  if (head.starts_with("SGC") && head.size() > 3) {
    return WarpFormat::sciss;
  }
  TextLines lines(head);
  std::optional<std::string_view> line = lines.next();
  while (line && line->find_first_not_of(" \t") != std::string_view::npos &&
         (*line)[line->find_first_not_of(" \t")] == '#') {
    line = lines.next();
  }
  if (!line) {
    return std::nullopt;
  }
  const std::string_view first = line->substr(line->find_first_not_of(" \t"));
  const std::string small = in_small_letters(first);
  if (first.starts_with("<")) {
    return format_of_xml(head);
  }
  if (small.starts_with("openmesh ")) {
    return WarpFormat::easyblend;
  }
  if (is_sky_skan_line(small)) {
    return WarpFormat::skyskan;
  }
  if (is_domeprojection_line(small)) {
    return WarpFormat::domeprojection;
  }
  return is_obj_line(first) ? std::optional(WarpFormat::obj) : std::nullopt;
}

std::string head_of_file(const std::filesystem::path& path) {
  std::string head(warp_head_bytes, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(std::max<std::streamsize>(file.gcount(), 0)));
  return head;
}

bool has_no_source_size(WarpFormat format) {
  return format == WarpFormat::bourke || format == WarpFormat::pfm || format == WarpFormat::domeprojection ||
         format == WarpFormat::obj || format == WarpFormat::simcad || format == WarpFormat::easyblend;
}

std::optional<WarpFormat> format_of_ending(std::string_view ending) {
  const std::string small = in_small_letters(ending);
  for (std::size_t i = 0; i < std::size(format_names); ++i) {
    if (std::ranges::find(format_names[i].endings, small) != format_names[i].endings.end()) {
      return static_cast<WarpFormat>(i);
    }
  }
  return std::nullopt;
}

std::optional<WarpFormat> warp_format_of(const std::filesystem::path& path) {
  const auto format = format_of_content(head_of_file(path));
  return format ? format : format_of_ending(path.extension().string());
}

}  // namespace ergodome
