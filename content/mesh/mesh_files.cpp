#include "content/mesh/mesh_files.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>

#include "content/mesh/named_file.h"

namespace ergodome {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view blanks = " \t\r\n";

void add_file(const fs::path& folder, std::string_view name, std::vector<fs::path>& files) {
  const fs::path path = file_of_mesh(folder, std::string(name));
  if (!path.empty() && std::ranges::find(files, path) == files.end()) {
    files.push_back(path);
  }
}

//! What follows the first word of a line, without blanks at its ends.
std::string_view rest_of(std::string_view line) {
  const std::size_t end = line.find_last_not_of(blanks);
  line = line.substr(0, end == std::string_view::npos ? 0 : end + 1);
  const std::size_t word = line.find_first_of(blanks, std::min(line.find_first_not_of(blanks), line.size()));
  const std::size_t rest = word == std::string_view::npos ? word : line.find_first_not_of(blanks, word);
  return rest == std::string_view::npos ? std::string_view() : line.substr(rest);
}

//! Pictures that a library of materials names ("map_Kd -s 2 2 1 bark.png"): what ends a line and is there; options and names with blanks cannot be told
//! apart otherwise.
void add_pictures(const fs::path& folder, const fs::path& materials, std::vector<fs::path>& files) {
  std::ifstream text(materials);
  for (std::string line; std::getline(text, line);) {
    for (std::string_view rest = rest_of(line); !rest.empty(); rest = rest_of(rest)) {
      add_file(folder, rest, files);
    }
  }
}

std::vector<fs::path> files_of_obj(const fs::path& folder, const fs::path& mesh) {
  std::vector<fs::path> files;
  std::ifstream text(mesh);
  for (std::string line; std::getline(text, line);) {
    const std::size_t word = line.find_first_not_of(blanks);
    if (word != std::string::npos && line.compare(word, 6, "mtllib") == 0) {
      add_file(folder, rest_of(line), files);
    }
  }
  for (const fs::path& materials : std::vector<fs::path>(files)) {
    add_pictures(folder, materials, files);
  }
  return files;
}

//! What stands under "uri" in the JSON of a .gltf, or in the chunk of it that a .glb begins with.
std::vector<fs::path> files_of_gltf(const fs::path& folder, const fs::path& mesh) {
  constexpr std::string_view key = "\"uri\"";
  std::vector<fs::path> files;
  std::ifstream file(mesh, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  for (std::size_t at = text.find(key); at != std::string::npos; at = text.find(key, at + 1)) {
    const std::size_t begin = text.find('"', at + key.size());
    const std::size_t end = begin == std::string::npos ? begin : text.find('"', begin + 1);
    // Data that stands in the file itself is no name, and long.
    if (end != std::string::npos && end - begin < 4096) {
      add_file(folder, std::string_view(text).substr(begin + 1, end - begin - 1), files);
    }
  }
  return files;
}

}  // namespace

std::vector<fs::path> files_of_mesh(const fs::path& mesh) {
  const fs::path folder = mesh.has_parent_path() ? mesh.parent_path() : fs::path(".");
  std::string ending = mesh.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (ending == ".obj") {
    return files_of_obj(folder, mesh);
  }
  return ending == ".gltf" || ending == ".glb" ? files_of_gltf(folder, mesh) : std::vector<fs::path>{};
}

}  // namespace ergodome
