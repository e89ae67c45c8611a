#include "content/mesh/whole_mesh.h"

#include <cstdint>
#include <cstring>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "kernels/core/error.h"

namespace ergodome {

namespace {

//! Throws Error unless the lengths in a GLB are those of its bytes: the importer makes room for whatever they say.
void check_glb(std::string_view bytes, const std::string& place) {
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
    throw Error(place, "is no GLB, or a torn one", wanted_meshes);
  }
}

//! Throws Error where an OBJ breaks off within a face: the importer takes what is left of it for a line, and leaves it out. One that breaks off between two
//! faces is a smaller mesh, which nothing tells from a whole one.
void check_obj_end(std::string_view bytes, const std::string& place) {
  const std::size_t end_of_last = bytes.rfind('\n');
  std::istringstream last(std::string(bytes.substr(end_of_last == std::string_view::npos ? 0 : end_of_last + 1)));
  const std::vector<std::string> words{std::istream_iterator<std::string>(last), {}};
  if (!words.empty() && words[0] == "f" && words.size() < 4) {
    throw Error(place, "is torn: it breaks off within a face", "copy or export it again");
  }
}

}  // namespace

void require_whole_mesh(std::string_view bytes, MeshFormat format, const std::string& place) {
  if (format == MeshFormat::glb) {
    check_glb(bytes, place);
  }
  if (format == MeshFormat::obj) {
    check_obj_end(bytes, place);
  }
}

}  // namespace ergodome
