#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "content/mesh/formats/mesh_reader.h"
#include "kernels/core/error.h"

namespace {

//! Ends the fuzzer with an error if the mesh's parts refer to indices or vertices outside the mesh.
void check(const ergodome::TriangleMesh& mesh) {
  std::size_t next = 0;
  for (const ergodome::MeshPart& part : mesh.parts) {
    if (part.first_index != next || part.index_count == 0 || part.index_count % 3 != 0) {
      std::abort();
    }
    next += part.index_count;
  }
  for (const std::uint32_t index : mesh.indices) {
    if (index >= mesh.vertices.size()) {
      std::abort();
    }
  }
  if (next != mesh.indices.size() || !(ergodome::radius_of(mesh) > 0.0)) {
    std::abort();
  }
}

}  // namespace

// The first byte chooses the format; the rest is the mesh file. Any file either contains a mesh
// that can be drawn, or throws an Error.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) {
    return 0;
  }
  const auto format = static_cast<ergodome::MeshFormat>(data[0] % 3);
  try {
    check(ergodome::parse_mesh({reinterpret_cast<const char*>(data + 1), size - 1}, format, "fuzz mesh"));
  } catch (const ergodome::Error&) {
    return 0;
  }
  return 0;
}
