#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace ergodome {

//! An image that a material names, and its mapping to the surface: u * scale + offset.
struct ObjTexture {
  std::string name;  //!< image name as written in the file; empty if there is none
  std::array<double, 2> scale = {1.0, 1.0};
  std::array<double, 2> offset = {0.0, 0.0};
  bool clamp = false;
};

//! The properties of a Wavefront MTL material that are drawn or remarked on.
struct ObjMaterial {
  std::array<float, 3> diffuse = {0.6F, 0.6F, 0.6F};
  bool has_diffuse = false;
  bool diffuse_unread = false;  //!< Kd is present but not three numbers: a spectrum, or numbers with decimal commas
  std::array<float, 3> emission = {0.0F, 0.0F, 0.0F};
  ObjTexture diffuse_texture;
  ObjTexture emission_texture;
  bool transparent = false;
};

using ObjMaterials = std::map<std::string, ObjMaterial, std::less<>>;

//! Adds the materials of a file's text. If two have the same name, the first one counts.
void add_obj_materials(std::string_view text, ObjMaterials& materials);

//! Reads the text of a map_ statement: options with their numbers, then a name that may contain
//! blanks.
ObjTexture obj_texture(std::string_view text);

//! Returns the names in an mtllib statement: one name if it is quoted or a file with that name,
//! blanks included, exists; else one name per word, at most 64.
std::vector<std::string> library_names(std::string_view rest, const std::filesystem::path& folder);

}  // namespace ergodome
