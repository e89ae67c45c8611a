#pragma once

#include <tiny_gltf.h>

#include <cstdint>
#include <string>
#include <vector>

#include "kernels/core/error.h"

namespace ergodome {

//! A glTF file that was read, as its parts look things up in it.
struct GltfFile {
  const tinygltf::Model& model;
  const std::string& place;  //!< how messages call it

  [[nodiscard]] Error error(const std::string& problem) const {
    return {place, problem, "export the mesh again, or check it with a glTF validator"};
  }

  //! An entry of one of the file's lists, which is called `what`. Throws Error where it is not there.
  template <class Entry>
  const Entry& at(const std::vector<Entry>& entries, int index, const char* what) const {
    if (index < 0 || static_cast<std::size_t>(index) >= entries.size()) {
      throw error(std::string("refers to ") + what + " " + std::to_string(index) + ", which does not exist");
    }
    return entries[static_cast<std::size_t>(index)];
  }
};

//! Numbers of an accessor, `components` each.
struct GltfNumbers {
  int components = 0;
  std::vector<float> values;

  [[nodiscard]] std::size_t count() const {
    return components > 0 ? values.size() / static_cast<std::size_t>(components) : 0;
  }
  [[nodiscard]] const float* operator[](std::size_t i) const {
    return values.data() + i * static_cast<std::size_t>(components);
  }
};

//! Returns how many entries an accessor has, after checking that its buffer holds them. Nothing is read.
std::size_t gltf_count(const GltfFile& file, int accessor);

//! Reads an accessor of any component type: normalized integers become fractions, others numbers (glTF 2.0, 3.6.2 and
//! KHR_mesh_quantization); sparse entries replace those of the buffer, which are zero without one. Throws Error where its bytes are not in its buffer.
GltfNumbers gltf_numbers(const GltfFile& file, int accessor);

//! Reads an accessor of whole numbers: indices, joints.
std::vector<std::uint32_t> gltf_whole_numbers(const GltfFile& file, int accessor);

}  // namespace ergodome
