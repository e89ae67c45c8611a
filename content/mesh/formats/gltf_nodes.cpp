#include "content/mesh/formats/gltf_nodes.h"

#include <fmt/format.h>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <utility>

namespace ergodome {

namespace {

glm::dmat4 own_matrix(const tinygltf::Node& node) {
  if (node.matrix.size() == 16) {
    return glm::make_mat4(node.matrix.data());
  }
  glm::dmat4 matrix(1.0);
  if (node.translation.size() == 3) {
    matrix = glm::translate(matrix, glm::make_vec3(node.translation.data()));
  }
  if (node.rotation.size() == 4) {
    const std::vector<double>& q = node.rotation;
    matrix *= glm::mat4_cast(glm::dquat(q[3], q[0], q[1], q[2]));
  }
  if (node.scale.size() == 3) {
    matrix = glm::scale(matrix, glm::make_vec3(node.scale.data()));
  }
  return matrix;
}

//! Returns the parent of each node; -1 for none.
std::vector<int> parents_of(const GltfFile& file) {
  const std::vector<tinygltf::Node>& nodes = file.model.nodes;
  std::vector<int> parents(nodes.size(), -1);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (const int child : nodes[i].children) {
      file.at(nodes, child, "node");
      int& parent = parents[static_cast<std::size_t>(child)];
      if (parent >= 0 || static_cast<std::size_t>(child) == i) {
        throw file.error(fmt::format("has node {} more than once in its tree", child));
      }
      parent = static_cast<int>(i);
    }
  }
  return parents;
}

//! Returns the root nodes of the default or first scene; in a file without scenes, all nodes
//! without a parent.
std::vector<int> roots_of(const GltfFile& file, const std::vector<int>& parents) {
  if (!file.model.scenes.empty()) {
    const std::vector<int>& named = file.at(file.model.scenes, std::max(file.model.defaultScene, 0), "scene").nodes;
    for (const int node : named) {
      file.at(file.model.nodes, node, "node");
    }
    return named;
  }
  std::vector<int> roots;
  for (std::size_t i = 0; i < parents.size(); ++i) {
    if (parents[i] < 0) {
      roots.push_back(static_cast<int>(i));
    }
  }
  return roots;
}

//! Returns true if KHR_node_visibility hides a node with its children.
bool is_hidden(const tinygltf::Node& node) {
  const auto found = node.extensions.find("KHR_node_visibility");
  if (found == node.extensions.end() || !found->second.Has("visible")) {
    return false;
  }
  const tinygltf::Value& visible = found->second.Get("visible");
  return visible.IsBool() && !visible.Get<bool>();
}

}  // namespace

GltfNodes gltf_nodes(const GltfFile& file) {
  const std::vector<int> parents = parents_of(file);
  GltfNodes result;
  result.world.assign(file.model.nodes.size(), glm::dmat4(1.0));
  std::vector<bool> seen(file.model.nodes.size());
  std::vector<bool> hidden(file.model.nodes.size());
  std::vector<int> open = roots_of(file, parents);
  while (!open.empty()) {
    const int index = open.back();
    open.pop_back();
    const auto at = static_cast<std::size_t>(index);
    if (seen[at]) {
      throw file.error(fmt::format("has node {} more than once in its tree", index));
    }
    seen[at] = true;
    const tinygltf::Node& node = file.model.nodes[at];
    const int parent = parents[at];
    const bool hangs = parent >= 0 && seen[static_cast<std::size_t>(parent)];
    result.world[at] = (hangs ? result.world[static_cast<std::size_t>(parent)] : glm::dmat4(1.0)) * own_matrix(node);
    hidden[at] = (hangs && hidden[static_cast<std::size_t>(parent)]) || is_hidden(node);
    if (node.mesh >= 0) {
      file.at(file.model.meshes, node.mesh, "mesh");
    }
    if (node.mesh >= 0 && !hidden[at]) {
      result.instances.push_back({index, node.mesh});
    }
    open.insert(open.end(), node.children.begin(), node.children.end());
  }
  if (file.model.nodes.empty()) {
    for (std::size_t i = 0; i < file.model.meshes.size(); ++i) {
      result.instances.push_back({-1, static_cast<int>(i)});
    }
  }
  return result;
}

}  // namespace ergodome
