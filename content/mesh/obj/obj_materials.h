#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace ergodome {

//! A picture that a material names, and how it lies on the surface: u * scale + offset.
struct ObjTexture {
  std::string name;  //!< as the file has it; empty: none
  std::array<double, 2> scale = {1.0, 1.0};
  std::array<double, 2> offset = {0.0, 0.0};
  bool clamp = false;
};

//! A material of a Wavefront MTL file, as far as it is drawn or remarked on.
struct ObjMaterial {
  std::array<float, 3> diffuse = {0.6F, 0.6F, 0.6F};
  bool has_diffuse = false;
  bool diffuse_unread = false;  //!< Kd is there, but no three numbers: a spectrum, or numbers with decimal commas
  std::array<float, 3> emission = {0.0F, 0.0F, 0.0F};
  ObjTexture diffuse_texture;
  ObjTexture emission_texture;
  bool transparent = false;
};

using ObjMaterials = std::map<std::string, ObjMaterial, std::less<>>;

//! Adds the materials of a file's text; of two with one name the first counts.
void add_obj_materials(std::string_view text, ObjMaterials& materials);

//! Reads the text of a map_ statement: options, each with its numbers, then a name that may hold blanks.
ObjTexture obj_texture(std::string_view text);

//! Returns the names in an mtllib statement: one name with blanks where such a file is there, else one name a word.
std::vector<std::string> library_names(std::string_view rest, const std::filesystem::path& folder);

}  // namespace ergodome
