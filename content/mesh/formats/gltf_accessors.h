#pragma once

#include <tiny_gltf.h>

#include <cstdint>
#include <string>
#include <vector>

#include "kernels/core/error.h"

namespace ergodome {

//! A parsed glTF file with checked access to its lists.
struct GltfFile {
  const tinygltf::Model& model;
  const std::string& location;  //!< its name in messages

  [[nodiscard]] Error error(const std::string& problem) const {
    return {location, problem, "export the mesh again, or check it with a glTF validator"};
  }

  //! Returns an entry of one of the file's lists; `what` is its name in messages. Throws Error if
  //! the index is out of range.
  template <class Entry>
  const Entry& at(const std::vector<Entry>& entries, int index, const char* what) const {
    if (index < 0 || static_cast<std::size_t>(index) >= entries.size()) {
      throw error(std::string("refers to ") + what + " " + std::to_string(index) + ", which does not exist");
    }
    return entries[static_cast<std::size_t>(index)];
  }
};

//! Values of an accessor, `components` per entry.
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

//! Returns the number of entries of an accessor without reading them. Throws Error if its buffer
//! does not contain them, or if it has more than 4 million entries but no buffer.
std::size_t gltf_count(const GltfFile& file, int accessor);

//! Reads an accessor of any component type: normalized integers become fractions, other integers
//! keep their values (glTF 2.0, 3.6.2 and KHR_mesh_quantization). Sparse entries replace those of
//! the buffer, or zeros without a buffer. Throws Error if its buffer does not contain its bytes.
GltfNumbers gltf_numbers(const GltfFile& file, int accessor);

//! Reads an accessor of unsigned integers, such as vertex indices. Throws Error for other component
//! types and for normalized integers.
std::vector<std::uint32_t> gltf_whole_numbers(const GltfFile& file, int accessor);

}  // namespace ergodome
