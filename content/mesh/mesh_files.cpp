#include "content/mesh/mesh_files.h"

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "content/files/whole_file.h"
#include "content/mesh/mesh_limits.h"
#include "content/mesh/obj/named_file.h"
#include "content/mesh/obj/obj_reader.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

namespace fs = std::filesystem;

void add_file(const fs::path& folder, std::string_view name, std::vector<fs::path>& files) {
  constexpr std::size_t most_files = 1000;
  const fs::path path = file_of_mesh(folder, std::string(name));
  if (!path.empty() && files.size() < most_files && std::ranges::find(files, path) == files.end()) {
    files.push_back(path);
  }
}

//! Returns the files named under "uri" in the JSON of a .gltf, or in the JSON chunk of a .glb.
std::vector<fs::path> files_of_gltf(std::string_view text, const fs::path& folder) {
  constexpr std::string_view key = "\"uri\"";
  std::vector<fs::path> files;
  for (std::size_t at = text.find(key); at != std::string::npos; at = text.find(key, at + 1)) {
    const std::size_t begin = text.find('"', at + key.size());
    const std::size_t end = begin == std::string::npos ? begin : text.find('"', begin + 1);
    // Longer values are embedded data, not names.
    if (end != std::string::npos && end - begin < 4096) {
      const auto name = nlohmann::json::parse(text.substr(begin, end - begin + 1), nullptr, false);
      add_file(folder, name.is_string() ? name.get<std::string>() : "", files);
    }
  }
  return files;
}

}  // namespace

std::vector<fs::path> files_of_mesh(const fs::path& mesh) {
  const fs::path folder = mesh.has_parent_path() ? mesh.parent_path() : fs::path(".");
  std::string ending = mesh.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const bool obj = ending == ".obj";
  if (!obj && ending != ".gltf" && ending != ".glb") {
    return {};
  }
  try {
    const std::string text = read_whole_file(mesh, largest_mesh_bytes, wanted_meshes);
    return obj ? files_of_obj(text, folder) : files_of_gltf(text, folder);
  } catch (const Error&) {
    return {};  // The mesh reader reports what is wrong.
  }
}

}  // namespace ergodome
