#include "content/mesh/mesh_reader.h"

#include <assimp/BaseImporter.h>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <assimp/IOStream.hpp>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <cctype>
#include <cmath>
#include <cstring>
#include <memory>

#include "content/files/counted.h"
#include "content/files/whole_file.h"
#include "content/mesh/material_names.h"
#include "content/mesh/mesh_normals.h"
#include "content/mesh/mesh_part.h"
#include "content/mesh/named_file.h"
#include "content/mesh/whole_mesh.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

//! Bytes as the importer reads them.
class ByteStream : public Assimp::IOStream {
 public:
  explicit ByteStream(std::string_view bytes) : bytes_(bytes) {}
  explicit ByteStream(std::string owned) : owned_(std::move(owned)), bytes_(owned_) {}

  std::size_t Read(void* to, std::size_t size, std::size_t count) override {
    const std::size_t whole = size > 0 ? std::min(count, (bytes_.size() - at_) / size) : 0;
    if (whole > 0) {
      std::memcpy(to, bytes_.data() + at_, whole * size);
      at_ += whole * size;
    }
    return whole;
  }
  std::size_t Write(const void* /*from*/, std::size_t /*size*/, std::size_t /*count*/) override { return 0; }
  aiReturn Seek(std::size_t offset, aiOrigin origin) override {
    const std::size_t from = origin == aiOrigin_SET ? 0 : origin == aiOrigin_CUR ? at_ : bytes_.size();
    if (offset > bytes_.size() - from) {
      return aiReturn_FAILURE;
    }
    at_ = from + offset;
    return aiReturn_SUCCESS;
  }
  [[nodiscard]] std::size_t Tell() const override { return at_; }
  [[nodiscard]] std::size_t FileSize() const override { return bytes_.size(); }
  void Flush() override {}

 private:
  std::string owned_;
  std::string_view bytes_;
  std::size_t at_ = 0;
};

//! What the importer may read: the mesh itself, and files in its folder or below. Nothing is written.
class MeshFiles : public Assimp::IOSystem {
 public:
  MeshFiles(std::string name, std::string_view bytes, std::filesystem::path folder)
      : name_(std::move(name)), bytes_(bytes), folder_(std::move(folder)) {}

  bool Exists(const char* file) const override { return file == name_ || !inside(file).empty(); }
  [[nodiscard]] char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char* file, const char* mode) override {
    if (std::strchr(mode, 'w') != nullptr) {
      return nullptr;
    }
    if (file == name_) {
      return std::make_unique<ByteStream>(bytes_).release();
    }
    const std::filesystem::path path = inside(file);
    if (path.empty()) {
      missing_ = missing_.empty() ? std::filesystem::path(file).lexically_normal().string() : missing_;
      return nullptr;
    }
    return std::make_unique<ByteStream>(read_whole_file(path, largest_mesh_bytes, "mend the mesh")).release();
  }
  void Close(Assimp::IOStream* stream) override { const std::unique_ptr<Assimp::IOStream> gone(stream); }

  //! The first file that the importer asked for and did not get; empty where it got all.
  [[nodiscard]] const std::string& missing() const { return missing_; }

 private:
  [[nodiscard]] std::filesystem::path inside(const std::string& file) const { return file_of_mesh(folder_, file); }

  std::string name_;
  std::string_view bytes_;
  std::filesystem::path folder_;
  std::string missing_;
};

//! Leaves an importer nothing but its readers of OBJ and glTF 2: it would take files for another kind by their first bytes.
void keep_wanted_readers(Assimp::Importer& importer) {
  for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
    const std::string_view kind = importer.GetImporterInfo(i)->mName;
    if (kind != "Wavefront Object Importer" && kind != "glTF2 Importer") {
      const std::unique_ptr<Assimp::BaseImporter> unwanted(importer.GetImporter(i));
      importer.UnregisterLoader(unwanted.get());
    }
  }
}

const char* ending_of(MeshFormat format) {
  constexpr const char* endings[] = {".obj", ".gltf", ".glb"};
  return endings[static_cast<int>(format)];
}

MeshFormat format_of(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const MeshFormat format : {MeshFormat::obj, MeshFormat::gltf, MeshFormat::glb}) {
    if (ending == ending_of(format)) {
      return format;
    }
  }
  throw Error(path.string(), "is no kind of mesh that is read", wanted_meshes);
}

SurfaceVertex vertex_of(const aiMesh& mesh, unsigned i) {
  const aiVector3D& p = mesh.mVertices[i];
  const aiVector3D n = mesh.HasNormals() ? mesh.mNormals[i] : aiVector3D(0.0F, 0.0F, 1.0F);
  const aiVector3D t = mesh.HasTextureCoords(0) ? mesh.mTextureCoords[0][i] : aiVector3D();
  return {{p.x, p.y, p.z}, {n.x, n.y, n.z}, {t.x, t.y}};
}

//! Adds one of the importer's meshes: one part.
void add_part(const aiScene& scene, const aiMesh& from, const std::string& place, const std::filesystem::path& folder,
              TriangleMesh& mesh) {
  MeshPart part = part_of(scene, from, place, folder);
  const auto first_vertex = static_cast<std::uint32_t>(mesh.vertices.size());
  part.first_index = static_cast<std::uint32_t>(mesh.indices.size());
  for (unsigned i = 0; i < from.mNumVertices; ++i) {
    mesh.vertices.push_back(vertex_of(from, i));
  }
  for (unsigned i = 0; i < from.mNumFaces; ++i) {
    const aiFace& face = from.mFaces[i];
    if (face.mNumIndices != 3) {
      continue;
    }
    for (unsigned k = 0; k < 3; ++k) {
      if (face.mIndices[k] >= from.mNumVertices) {
        throw Error(place, "has a face with a corner that is not there", "export the mesh again");
      }
      const aiVector3D& corner = from.mVertices[face.mIndices[k]];
      if (!(std::isfinite(corner.x) && std::isfinite(corner.y) && std::isfinite(corner.z))) {
        throw Error(place, "has a face with a corner whose place is no number",
                    "give it three, or export the mesh again");
      }
      mesh.indices.push_back(first_vertex + face.mIndices[k]);
    }
  }
  part.index_count = static_cast<std::uint32_t>(mesh.indices.size()) - part.first_index;
  remark_on(part, from, mesh);
  mesh.parts.push_back(std::move(part));
}

void check_size(const aiScene& scene, const std::string& place) {
  std::size_t triangles = 0;
  std::size_t vertices = 0;
  for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
    triangles += scene.mMeshes[i]->mNumFaces;
    vertices += scene.mMeshes[i]->mNumVertices;
  }
  if (triangles > most_mesh_triangles || vertices > 3 * most_mesh_triangles) {
    throw Error(place, fmt::format("has {} triangles", triangles),
                fmt::format("simplify it to {} at the most", most_mesh_triangles));
  }
}

TriangleMesh import_mesh(std::string_view bytes, MeshFormat format, const std::string& place,
                         const std::filesystem::path& folder) {
  const std::string name = fmt::format("mesh{}", ending_of(format));
  Assimp::Importer importer;
  keep_wanted_readers(importer);
  auto files = std::make_unique<MeshFiles>(name, bytes, folder);
  const MeshFiles& asked = *files;
  importer.SetIOHandler(files.release());  // the importer owns it
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  const aiScene* const scene = importer.ReadFile(name, aiProcess_Triangulate | aiProcess_SortByPType |
                                                           aiProcess_GenSmoothNormals | aiProcess_PreTransformVertices);
  if (scene == nullptr || scene->mNumMeshes == 0) {
    const std::string reason = importer.GetErrorString();
    throw Error(place, fmt::format("is no mesh with triangles{}{}", reason.empty() ? "" : ": ", reason), wanted_meshes);
  }
  // The importer of OBJ goes on without materials, and everything would be grey.
  if (!folder.empty() && !asked.missing().empty()) {
    throw missing_file(place, asked.missing());
  }
  check_size(*scene, place);
  TriangleMesh mesh;
  for (unsigned i = 0; i < scene->mNumMeshes; ++i) {
    add_part(*scene, *scene->mMeshes[i], place, folder, mesh);
  }
  return mesh;
}

}  // namespace

TriangleMesh parse_mesh(std::string_view bytes, MeshFormat format, const std::string& place,
                        const std::filesystem::path& folder) {
  if (bytes.size() > largest_mesh_bytes) {
    throw Error(place, "is larger than 1 GiB", "simplify the mesh");
  }
  require_whole_mesh(bytes, format, place);
  TriangleMesh mesh;
  try {
    mesh = import_mesh(bytes, format, place, folder);
  } catch (const Error&) {
    throw;
  } catch (const std::exception& problem) {
    throw Error(place, fmt::format("cannot be read: {}", problem.what()), wanted_meshes);
  }
  if (format == MeshFormat::obj && !folder.empty()) {
    remark_on_materials(missing_materials(bytes, folder), mesh);
  }
  drop_degenerate_triangles(mesh);
  mend_normals(mesh);
  if (mesh.indices.empty()) {
    throw Error(place,
                mesh.dropped_triangles > 0
                    ? fmt::format("has {}, all without area", counted(mesh.dropped_triangles, "triangle"))
                    : std::string("is empty"),
                "give a mesh with triangles");
  }
  return mesh;
}

TriangleMesh read_mesh(const std::filesystem::path& path) {
  const MeshFormat format = format_of(path);
  const std::string bytes = read_whole_file(path, largest_mesh_bytes, wanted_meshes);
  std::filesystem::path folder = path.parent_path();
  return parse_mesh(bytes, format, path.string(), folder.empty() ? std::filesystem::path(".") : folder);
}

}  // namespace ergodome
