#include "content/mesh/obj_materials.h"

#include <algorithm>

#include "content/mesh/named_file.h"
#include "content/mesh/obj_lines.h"

namespace ergodome {

namespace {

bool take_color(std::string_view text, std::array<float, 3>& color) {
  std::array<double, 3> numbers{};
  if (!take_number(text, numbers[0])) {
    return false;  // "spectral" and "xyz" name other spaces, which no program writes.
  }
  // One number stands for three.
  for (std::size_t i = 1; i < 3; ++i) {
    numbers.at(i) = take_number(text, numbers.at(i)) ? numbers.at(i) : numbers[0];
  }
  std::ranges::transform(numbers, color.begin(), [](double number) { return static_cast<float>(number); });
  return true;
}

void read_statement(const ObjLines& lines, ObjMaterial& material) {
  std::string_view rest = lines.rest();
  const std::string_view keyword = lines.keyword();
  double number = 0.0;
  if (keyword == "Kd") {
    material.has_diffuse = take_color(rest, material.diffuse) || material.has_diffuse;
  } else if (keyword == "Ke") {
    take_color(rest, material.emission);
  } else if (keyword == "map_Kd") {
    material.diffuse_texture = obj_texture(rest);
  } else if (keyword == "map_Ke") {
    material.emission_texture = obj_texture(rest);
  } else if (keyword == "d" && take_number(rest, number)) {
    material.transparent = material.transparent || number < 1.0;
  } else if (keyword == "Tr" && take_number(rest, number)) {
    // The inverse of d. Old programs wrote d's value here; a wholly transparent body was not meant.
    material.transparent = material.transparent || (number > 0.0 && number < 1.0);
  }
}

}  // namespace

void add_obj_materials(std::string_view text, ObjMaterials& materials) {
  ObjMaterial ignored;
  ObjMaterial* current = &ignored;
  for (ObjLines lines(text); lines.next();) {
    if (lines.keyword() == "newmtl") {
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
      break;  // a name may begin with a hyphen
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
  constexpr std::size_t most_names = 64;
  std::vector<std::string> names;
  while (names.size() < most_names) {
    const std::string_view word = take_word_of(rest);
    if (word.empty()) {
      break;
    }
    names.emplace_back(unquoted(word));
  }
  return names;
}

}  // namespace ergodome
