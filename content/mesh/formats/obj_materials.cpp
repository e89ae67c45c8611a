#include "content/mesh/formats/obj_materials.h"

#include <algorithm>
#include <cctype>

#include "content/mesh/formats/obj_lines.h"
#include "content/mesh/named_file.h"

namespace ergodome {

namespace {

bool take_color(std::string_view text, std::array<float, 3>& color) {
  std::array<double, 3> numbers{};
  std::size_t count = 0;
  while (count < 3 && take_number(text, numbers.at(count))) {
    ++count;
  }
  const std::string_view behind = take_word_of(text);
  if (count == 0 || (count < 3 && !behind.empty() && behind.front() != '#')) {
    return false;  // not a number, but a word such as "spectral" or "xyz", which selects another color space
  }
  // A single number stands for all three.
  for (; count < 3; ++count) {
    numbers.at(count) = numbers[0];
  }
  std::ranges::transform(numbers, color.begin(), [](double number) { return static_cast<float>(number); });
  return true;
}

//! Converts a keyword to lower case, as some programs write "map_kd" and "KD".
std::string lower_case(std::string_view keyword) {
  std::string lower(keyword);
  std::ranges::transform(lower, lower.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower;
}

void read_statement(const ObjLines& lines, ObjMaterial& material) {
  std::string_view rest = lines.rest();
  const std::string keyword = lower_case(lines.keyword());
  double number = 0.0;
  if (keyword == "kd") {
    const bool read = take_color(rest, material.diffuse);
    material.has_diffuse = read || material.has_diffuse;
    material.diffuse_unread = material.diffuse_unread || !read;
  } else if (keyword == "ke") {
    take_color(rest, material.emission);
  } else if (keyword == "map_kd") {
    material.diffuse_texture = obj_texture(rest);
  } else if (keyword == "map_ke") {
    material.emission_texture = obj_texture(rest);
  } else if (keyword == "map_d") {
    material.transparent = true;
  } else if (keyword == "d") {
    std::string_view behind = rest;
    rest = take_word_of(behind) == "-halo" ? behind : rest;
    material.transparent = material.transparent || (take_number(rest, number) && number < 1.0);
  } else if (keyword == "tr" && take_number(rest, number)) {
    // Tr is 1 - d, but old programs wrote the value of d; so 1 is not taken for a fully transparent
    // body.
    material.transparent = material.transparent || (number > 0.0 && number < 1.0);
  }
}

}  // namespace

void add_obj_materials(std::string_view text, ObjMaterials& materials) {
  ObjMaterial ignored;
  ObjMaterial* current = &ignored;
  for (ObjLines lines(text); lines.next();) {
    if (lower_case(lines.keyword()) == "newmtl") {
      const auto [at, is_new] = materials.try_emplace(std::string(unquoted(lines.rest())));
      current = is_new ? &at->second : &ignored;
    } else {
      read_statement(lines, *current);
    }
  }
}

ObjTexture obj_texture(std::string_view text) {
  ObjTexture texture;
  while (text.starts_with('-')) {
    std::string_view rest = text;
    const std::string_view option = take_word_of(rest);
    double number = 0.0;
    if (option == "-o" || option == "-s") {
      std::array<double, 2>& pair = option == "-o" ? texture.offset : texture.scale;
      for (std::size_t i = 0; i < 3 && take_number(rest, number); ++i) {
        pair.at(std::min<std::size_t>(i, 1)) = i < 2 ? number : pair[1];
      }
    } else if (option == "-t" || option == "-mm") {
      for (int i = 0; i < 3 && take_number(rest, number); ++i) {
      }
    } else if (option == "-clamp") {
      texture.clamp = take_word_of(rest) == "on";
    } else if (option == "-blendu" || option == "-blendv" || option == "-cc" || option == "-boost" ||
               option == "-texres" || option == "-bm" || option == "-imfchan" || option == "-type" ||
               option == "-colorspace") {
      take_word_of(rest);
    } else {
      break;  // not an option: the image's name may begin with a hyphen
    }
    text = rest;
    text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
  }
  texture.name = unquoted(text);
  return texture;
}

std::vector<std::string> library_names(std::string_view rest, const std::filesystem::path& folder) {
  const std::string whole(unquoted(rest));
  if (whole.find(' ') == std::string::npos || whole.size() != rest.size() || !file_of_mesh(folder, whole).empty()) {
    return {whole};
  }
  constexpr std::size_t max_names = 64;
  std::vector<std::string> names;
  while (names.size() < max_names) {
    const std::string_view word = take_word_of(rest);
    if (word.empty()) {
      break;
    }
    names.emplace_back(unquoted(word));
  }
  return names;
}

}  // namespace ergodome
