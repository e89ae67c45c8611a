#include "content/mesh/material_names.h"

#include <algorithm>
#include <set>

#include "content/files/whole_file.h"
#include "content/mesh/mesh_reader.h"
#include "content/mesh/named_file.h"

namespace ergodome {

namespace {

//! Calls body(name) for what follows a word that lines of a text begin with.
template <class Body>
void for_each_named(std::string_view text, std::string_view word, const Body& body) {
  constexpr std::string_view space = " \t\r";
  while (!text.empty()) {
    std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(text.size(), line.size() + 1));
    line.remove_prefix(std::min(line.find_first_not_of(space), line.size()));
    if (!line.starts_with(word) || line.size() == word.size() || space.find(line[word.size()]) == space.npos) {
      continue;
    }
    line.remove_prefix(std::min(line.find_first_not_of(space, word.size()), line.size()));
    line = line.substr(0, line.find_last_not_of(space) + 1);
    if (!line.empty()) {
      body(std::string(line));
    }
  }
}

}  // namespace

std::vector<std::string> missing_materials(std::string_view obj, const std::filesystem::path& folder) {
  std::set<std::string> libraries;
  for_each_named(obj, "mtllib", [&](const std::string& library) { libraries.insert(library); });
  std::set<std::string> known;
  for (const std::string& library : libraries) {
    const std::filesystem::path file = file_of_mesh(folder, library);
    if (!file.empty()) {
      const std::string text = read_whole_file(file, largest_mesh_bytes, "simplify the mesh");
      for_each_named(text, "newmtl", [&](const std::string& name) { known.insert(name); });
    }
  }
  std::vector<std::string> missing;
  for_each_named(obj, "usemtl", [&](const std::string& name) {
    if (known.insert(name).second) {
      missing.push_back(name);
    }
  });
  return missing;
}

}  // namespace ergodome
