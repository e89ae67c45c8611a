#include "app/commands/inspect/mesh_facts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <limits>
#include <map>

#include "content/files/console.h"
#include "content/files/counted.h"
#include "render/passes/objects/object_meshes.h"

namespace ergodome {

namespace {

bool is_opaque(const OverlayImage& image) {
  const std::size_t texels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  for (std::size_t i = 0; i < texels; ++i) {
    if (image.texels[4 * i + 3] != std::numeric_limits<std::uint16_t>::max()) {
      return false;
    }
  }
  return true;
}

Vector3<double> extent_of(const TriangleMesh& mesh) {
  std::array<double, 3> least;
  std::array<double, 3> greatest;
  least.fill(std::numeric_limits<double>::infinity());
  greatest.fill(-std::numeric_limits<double>::infinity());
  for (const std::uint32_t index : mesh.indices) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto place = static_cast<double>(mesh.vertices[index].position[axis]);
      least.at(axis) = std::min(least.at(axis), place);
      greatest.at(axis) = std::max(greatest.at(axis), place);
    }
  }
  return {greatest[0] - least[0], greatest[1] - least[1], greatest[2] - least[2]};
}

}  // namespace

MeshFacts facts_of_mesh(const std::string& file, const TriangleMesh& mesh) {
  MeshFacts facts = {file, mesh.triangle_count(), mesh.dropped_triangles, extent_of(mesh), mesh.remarks};
  std::map<std::string, bool> opaque;
  for (const MeshPart& part : mesh.parts) {
    if (!part.image.empty() && part.image_alpha_counts && !opaque.contains(part.image.name)) {
      opaque[part.image.name] = is_opaque(read_mesh_image(part.image));
    }
  }
  for (const auto& [image, is] : opaque) {
    if (!is) {
      facts.remarks.push_back(fmt::format("has a texture with transparent areas ({}), which are drawn opaque",
                                          std::filesystem::path(image).filename().string()));
    }
  }
  return facts;
}

nlohmann::json facts_of_meshes(const Show& show, const std::vector<MeshFacts>& meshes) {
  nlohmann::json facts = nlohmann::json::array();
  for (std::size_t i = 0; i < show.objects.size(); ++i) {
    const ObjectSettings& object = show.objects[i];
    const auto mesh = std::ranges::find(meshes, object.mesh, &MeshFacts::file);
    if (object.form == ObjectForm::mesh && mesh != meshes.end()) {
      const Vector3<double> extent = object.size * mesh->extent;
      facts.push_back({{"key", fmt::format("objects[{}].mesh", i)},
                       {"file", mesh->file},
                       {"triangles", mesh->triangles},
                       {"without_area", mesh->dropped_triangles},
                       {"extent_M", {extent.x, extent.y, extent.z}},
                       {"remarks", mesh->remarks}});
    }
  }
  return facts;
}

void print_meshes(const nlohmann::json& facts) {
  if (!facts.empty()) {
    print_out("\nmeshes\n");
  }
  for (const nlohmann::json& mesh : facts) {
    const long dropped = mesh["without_area"].get<long>();
    const auto& extent = mesh["extent_M"];
    print_out("  {:<40} {}, {}{:.6g} x {:.6g} x {:.6g} M before rotation\n", mesh["file"].get<std::string>(),
              counted(mesh["triangles"].get<long>(), "triangle"),
              dropped > 0 ? fmt::format("{} without area omitted, ", dropped) : "", extent[0].get<double>(),
              extent[1].get<double>(), extent[2].get<double>());
    for (const auto& remark : mesh["remarks"]) {
      print_out("    {}\n", remark.get<std::string>());
    }
  }
}

}  // namespace ergodome
