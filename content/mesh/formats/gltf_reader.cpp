#include "content/mesh/formats/gltf_reader.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cstring>
#include <glm/gtc/type_ptr.hpp>
#include <glm/matrix.hpp>

#include "content/files/printable.h"
#include "content/files/whole_file.h"
#include "content/mesh/formats/gltf_bounds.h"
#include "content/mesh/formats/gltf_materials.h"
#include "content/mesh/formats/gltf_nodes.h"
#include "content/mesh/formats/gltf_primitives.h"
#include "content/mesh/mesh_builder.h"
#include "content/mesh/named_file.h"

namespace ergodome {

namespace {

//! Returns the JSON in the bytes of a .glb. Throws Error if the lengths in its headers do not match
//! its bytes.
std::string_view json_in_glb(std::string_view bytes, const std::string& location) {
  constexpr std::size_t head = 12;
  constexpr std::size_t chunk_head = 8;
  const auto word = [&](std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return std::size_t{value};
  };
  bool whole = bytes.size() >= head + chunk_head && bytes.starts_with("glTF") && word(8) == bytes.size();
  for (std::size_t at = head; whole && at < bytes.size();) {
    whole = bytes.size() - at >= chunk_head && word(at) <= bytes.size() - at - chunk_head;
    at += whole ? chunk_head + word(at) : 0;
  }
  if (!whole) {
    throw Error(location, "is not a GLB file, or is truncated", wanted_meshes);
  }
  return bytes.substr(head + chunk_head, word(head));
}

//! The files that the loader may read: those in the mesh's folder, or below.
struct FilesBeside {
  const std::filesystem::path& folder;
  std::string missing;  //!< the first missing file
  std::string problem;  //!< why a file could not be read

  [[nodiscard]] std::filesystem::path find(const std::string& name) const {
    if (std::filesystem::path found = file_of_mesh(folder, name); !found.empty()) {
      return found;
    }
    // The loader decodes a plus sign in a URI as a blank, so the name is also tried with plus signs
    // in place of blanks.
    std::string plus = name;
    std::ranges::replace(plus, ' ', '+');
    return file_of_mesh(folder, plus);
  }
};

//! Returns true for image files. The loader need not read them; they are read when they are drawn.
bool is_picture(const std::string& name) {
  std::string ending = std::filesystem::path(name).extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  constexpr std::string_view endings[] = {".png", ".jpg", ".jpeg", ".ktx2", ".webp", ".basis", ".dds"};
  return std::ranges::find(endings, ending) != std::end(endings);
}

bool is_data(std::string_view name) { return name.starts_with("data:"); }

//! Decodes a data URI (RFC 2397) of a media type that the loader does not know. Returns false if it
//! is not base64.
bool decode_data(const std::string& name, std::vector<unsigned char>& bytes) {
  constexpr std::string_view coding = ";base64,";
  const std::size_t head = name.substr(0, name.find(',') + 1).find(coding);
  if (head == std::string::npos) {
    return false;
  }
  std::string digits = name.substr(head + coding.size());
  std::ranges::replace(digits, ' ', '+');  // the loader decodes a plus sign in a URI as a blank
  std::string media_type;
  return tinygltf::DecodeDataURI(&bytes, media_type, "data:application/octet-stream;base64," + digits, 0, false);
}

tinygltf::FsCallbacks callbacks_of(FilesBeside& files) {
  tinygltf::FsCallbacks callbacks = {};
  callbacks.user_data = &files;
  callbacks.FileExists = [](const std::string& name, void* data) {
    return is_picture(name) || is_data(name) || !static_cast<FilesBeside*>(data)->find(name).empty();
  };
  callbacks.ExpandFilePath = [](const std::string& name, void* /*data*/) { return name; };
  callbacks.ReadWholeFile = [](std::vector<unsigned char>* bytes, std::string* /*error*/, const std::string& name,
                               void* data) {
    if (is_picture(name)) {
      return false;
    }
    if (is_data(name)) {
      return decode_data(name, *bytes);
    }
    auto& beside = *static_cast<FilesBeside*>(data);
    const std::filesystem::path file = beside.find(name);
    if (file.empty()) {
      beside.missing = beside.missing.empty() ? name : beside.missing;
      return false;
    }
    try {
      const std::string read = read_whole_file(file, largest_mesh_bytes, "a buffer may have at most 1 GiB");
      bytes->assign(read.begin(), read.end());
    } catch (const Error& problem) {
      beside.problem = problem.what();
      return false;
    }
    return true;
  };
  callbacks.WriteWholeFile = [](std::string* /*error*/, const std::string& /*name*/,
                                const std::vector<unsigned char>& /*bytes*/, void* /*data*/) { return false; };
  return callbacks;
}

//! Callback of the loader for embedded images: keeps the bytes in the encoding of the file.
bool keep_coded(tinygltf::Image* image, const int /*index*/, std::string* /*error*/, std::string* /*warning*/,
                int /*width*/, int /*height*/, const unsigned char* bytes, int size, void* /*data*/) {
  image->image.assign(bytes, bytes + std::max(size, 0));
  return true;
}

//! Returns the first line of the loader's message, which may quote the file.
std::string first_line(const std::string& text) {
  constexpr std::size_t longest = 200;
  return printable(text.substr(0, std::min(text.find('\n'), longest)));
}

//! Throws Error if the file requires an unsupported extension (glTF 2.0, 3.12).
void require_known_extensions(const GltfFile& file) {
  for (const std::string& name : file.model.extensionsRequired) {
    if (!is_known_gltf_extension(name)) {
      throw Error(file.location, fmt::format("requires the unsupported glTF extension {}", first_line(name)),
                  "export it without that extension");
    }
  }
}

//! Throws Error if the file is not glTF 2, requires an unsupported extension, or is a GLB with a
//! buffer after the first that has no URI and therefore no data.
void require_readable(const GltfFile& file, bool binary) {
  if (!file.model.asset.version.starts_with("2.")) {
    throw Error(file.location, fmt::format("is glTF {}, which is not supported", first_line(file.model.asset.version)),
                "export it as glTF 2.0");
  }
  require_known_extensions(file);
  for (std::size_t i = 1; binary && i < file.model.buffers.size(); ++i) {
    if (file.model.buffers[i].uri.empty()) {
      throw Error(file.location, fmt::format("has buffer {} without data, as in files with meshopt compression", i),
                  "export it without compression");
    }
  }
}

void load(std::string_view bytes, bool binary, const std::string& location, const std::filesystem::path& folder,
          tinygltf::Model& model) {
  require_bounded_gltf(binary ? json_in_glb(bytes, location) : bytes, location);
  throw_if_reading_stopped(location);
  FilesBeside files{folder, "", ""};
  tinygltf::TinyGLTF loader;
  loader.SetFsCallbacks(callbacks_of(files));
  loader.SetImageLoader(keep_coded, nullptr);
  std::string problem;
  std::string warning;
  const auto size = static_cast<unsigned int>(bytes.size());
  // tinygltf takes a pointer and a size, and reads no further.
  const char* const text = bytes.begin();
  const bool loaded = binary ? loader.LoadBinaryFromMemory(&model, &problem, &warning,
                                                           reinterpret_cast<const unsigned char*>(text), size)
                             : loader.LoadASCIIFromString(&model, &problem, &warning, text, size, "");
  if (!loaded) {
    require_known_extensions({model, location});
  }
  if (!files.problem.empty()) {
    throw Error(location, "refers to a file that cannot be read: " + files.problem, "replace that file");
  }
  if (!files.missing.empty()) {
    throw missing_file(location, files.missing);
  }
  if (!loaded) {
    throw Error(location, "cannot be read as glTF: " + first_line(problem), wanted_meshes);
  }
}

//! Returns the matrices of a skin's joints from the mesh's coordinates to the scene's.
std::vector<glm::dmat4> joints_of(const GltfFile& file, const GltfNodes& nodes, int skin_index) {
  if (skin_index < 0) {
    return {};
  }
  const tinygltf::Skin& skin = file.at(file.model.skins, skin_index, "skin");
  const GltfNumbers inverse =
      skin.inverseBindMatrices >= 0 ? gltf_numbers(file, skin.inverseBindMatrices) : GltfNumbers();
  if (!inverse.values.empty() && (inverse.components != 16 || inverse.count() < skin.joints.size())) {
    throw file.error("has a skin with fewer inverse bind matrices than joints");
  }
  std::vector<glm::dmat4> joints;
  for (std::size_t i = 0; i < skin.joints.size(); ++i) {
    const glm::dmat4 bind = inverse.values.empty() ? glm::dmat4(1.0) : glm::dmat4(glm::make_mat4(inverse[i]));
    joints.push_back(file.at(nodes.world, skin.joints[i], "node") * bind);
  }
  return joints;
}

void remark_on_nodes(const GltfFile& file, MeshBuilder& builder) {
  const auto has = [](const char* extension) {
    return [extension](const tinygltf::Node& node) { return node.extensions.contains(extension); };
  };
  if (std::ranges::any_of(file.model.nodes, has("EXT_mesh_gpu_instancing"))) {
    builder.remark("uses GPU instancing (EXT_mesh_gpu_instancing); only one instance is drawn");
  }
  if (std::ranges::any_of(file.model.nodes, has("MSFT_lod"))) {
    builder.remark("has levels of detail (MSFT_lod); only the finest is drawn");
  }
  if (!file.model.animations.empty()) {
    builder.remark("is animated; it is drawn in its default pose");
  }
}

}  // namespace

TriangleMesh read_gltf(std::string_view bytes, bool binary, const std::string& location,
                       const std::filesystem::path& folder) {
  tinygltf::Model model;
  load(bytes, binary, location, folder, model);
  const GltfFile file{model, location};
  require_readable(file, binary);
  const GltfNodes nodes = gltf_nodes(file);
  MeshBuilder builder(location);
  for (const GltfInstance& instance : nodes.instances) {
    const tinygltf::Mesh& mesh = model.meshes[static_cast<std::size_t>(instance.mesh)];
    GltfPlacement placement = {glm::dmat4(1.0), {}, mesh.weights.empty() ? nullptr : &mesh.weights};
    if (instance.node >= 0) {
      const tinygltf::Node& node = model.nodes[static_cast<std::size_t>(instance.node)];
      placement.world = nodes.world[static_cast<std::size_t>(instance.node)];
      placement.joints = joints_of(file, nodes, node.skin);
      placement.weights = node.weights.empty() ? placement.weights : &node.weights;
    }
    for (const tinygltf::Primitive& primitive : mesh.primitives) {
      throw_if_reading_stopped(location);
      add_gltf_primitive(file, primitive, placement, builder);
    }
  }
  remark_on_nodes(file, builder);
  return builder.take([&](int material) { return gltf_part(file, material, folder, builder); });
}

}  // namespace ergodome
