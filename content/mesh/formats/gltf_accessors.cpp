#include "content/mesh/formats/gltf_accessors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

namespace ergodome {

namespace {

using tinygltf::Accessor;

//! Memory layout of an accessor's entries.
struct Entries {
  const unsigned char* first = nullptr;  //!< null: all entries are zero
  std::size_t stride = 0;
  int component_type = 0;
  bool normalized = false;
};

std::size_t component_bytes(const GltfFile& file, int type) {
  const int bytes = tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(type));
  if (bytes <= 0 || type == TINYGLTF_COMPONENT_TYPE_DOUBLE) {
    throw file.error(fmt::format("has an accessor of the unknown component type {}", type));
  }
  return static_cast<std::size_t>(bytes);
}

int components_of(const GltfFile& file, const Accessor& accessor) {
  const int components = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type));
  if (components <= 0) {
    throw file.error("has an accessor of an unknown type");
  }
  return components;
}

//! Finds `count` entries of `entry_bytes` bytes in a buffer view. Throws Error if it does not
//! contain them.
Entries entries_in(const GltfFile& file, int view_index, std::size_t offset, std::size_t count,
                   std::size_t entry_bytes) {
  const tinygltf::BufferView& view = file.at(file.model.bufferViews, view_index, "buffer view");
  const tinygltf::Buffer& buffer = file.at(file.model.buffers, view.buffer, "buffer");
  const std::size_t stride = view.byteStride > 0 ? view.byteStride : entry_bytes;
  const std::size_t size = buffer.data.size();
  const bool view_fits = view.byteOffset <= size && view.byteLength <= size - view.byteOffset;
  const std::size_t room = view_fits ? view.byteLength - std::min(offset, view.byteLength) : 0;
  const bool fits =
      count == 0 || (room >= entry_bytes && stride >= entry_bytes && count - 1 <= (room - entry_bytes) / stride);
  if (!fits) {
    throw file.error("has an accessor that reaches beyond its buffer");
  }
  return {buffer.data.data() + view.byteOffset + offset, stride, 0, false};
}

std::size_t entry_bytes_of(const GltfFile& file, const Accessor& accessor) {
  return component_bytes(file, accessor.componentType) * static_cast<std::size_t>(components_of(file, accessor));
}

Entries entries_of(const GltfFile& file, const Accessor& accessor) {
  Entries entries;
  if (accessor.bufferView >= 0) {
    entries =
        entries_in(file, accessor.bufferView, accessor.byteOffset, accessor.count, entry_bytes_of(file, accessor));
  }
  entries.component_type = accessor.componentType;
  entries.normalized = accessor.normalized;
  return entries;
}

template <class Number>
double number_at(const unsigned char* from, bool normalized) {
  Number number;
  std::memcpy(&number, from, sizeof number);
  if constexpr (std::is_integral_v<Number>) {
    if (normalized) {
      return std::max(static_cast<double>(number) / static_cast<double>(std::numeric_limits<Number>::max()), -1.0);
    }
  }
  return static_cast<double>(number);
}

double number_of(const unsigned char* from, int type, bool normalized) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return number_at<std::int8_t>(from, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return number_at<std::uint8_t>(from, normalized);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return number_at<std::int16_t>(from, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return number_at<std::uint16_t>(from, normalized);
    case TINYGLTF_COMPONENT_TYPE_INT:
      return number_at<std::int32_t>(from, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return number_at<std::uint32_t>(from, normalized);
    default:
      return number_at<float>(from, normalized);
  }
}

//! Calls body(entry, component, number) for all numbers of `count` entries.
template <class Body>
void for_each_number(const GltfFile& file, const Entries& entries, std::size_t count, int components,
                     const Body& body) {
  const std::size_t bytes = component_bytes(file, entries.component_type);
  for (std::size_t i = 0; i < count; ++i) {
    for (int c = 0; c < components; ++c) {
      const unsigned char* const from = entries.first + i * entries.stride + static_cast<std::size_t>(c) * bytes;
      body(i, c, number_of(from, entries.component_type, entries.normalized));
    }
  }
}

//! Returns the accessor's numbers as `Number`, sparse ones included.
template <class Number>
std::vector<Number> all_numbers(const GltfFile& file, const Accessor& accessor) {
  const int components = components_of(file, accessor);
  const Entries entries = entries_of(file, accessor);
  std::vector<Number> numbers(accessor.count * static_cast<std::size_t>(components));
  const auto put = [&](std::size_t entry, int component, double number) {
    numbers[entry * static_cast<std::size_t>(components) + static_cast<std::size_t>(component)] =
        static_cast<Number>(number);
  };
  if (entries.first != nullptr) {
    for_each_number(file, entries, accessor.count, components, put);
  }
  if (!accessor.sparse.isSparse) {
    return numbers;
  }
  const auto& sparse = accessor.sparse;
  const auto count = static_cast<std::size_t>(std::max(sparse.count, 0));
  Entries where =
      entries_in(file, sparse.indices.bufferView, static_cast<std::size_t>(std::max(sparse.indices.byteOffset, 0)),
                 count, component_bytes(file, sparse.indices.componentType));
  where.component_type = sparse.indices.componentType;
  Entries what =
      entries_in(file, sparse.values.bufferView, static_cast<std::size_t>(std::max(sparse.values.byteOffset, 0)), count,
                 entry_bytes_of(file, accessor));
  what.component_type = accessor.componentType;
  what.normalized = accessor.normalized;
  std::vector<std::size_t> positions(count);
  for_each_number(file, where, count, 1, [&](std::size_t i, int /*component*/, double position) {
    if (!(position >= 0.0 && position < static_cast<double>(accessor.count))) {
      throw file.error("has a sparse accessor that replaces a nonexistent entry");
    }
    positions[i] = static_cast<std::size_t>(position);
  });
  for_each_number(file, what, count, components,
                  [&](std::size_t i, int component, double number) { put(positions[i], component, number); });
  return numbers;
}

//! Maximum number of entries without a buffer, which are zero (glTF 2.0, 3.6.2).
constexpr std::size_t max_zero_entries = 4'000'000;

}  // namespace

std::size_t gltf_count(const GltfFile& file, int index) {
  const Accessor& accessor = file.at(file.model.accessors, index, "accessor");
  if (entries_of(file, accessor).first == nullptr && accessor.count > max_zero_entries) {
    throw file.error(fmt::format("has an accessor with {} entries but no buffer", accessor.count));
  }
  return accessor.count;
}

GltfNumbers gltf_numbers(const GltfFile& file, int index) {
  gltf_count(file, index);
  const Accessor& accessor = file.at(file.model.accessors, index, "accessor");
  return {components_of(file, accessor), all_numbers<float>(file, accessor)};
}

std::vector<std::uint32_t> gltf_whole_numbers(const GltfFile& file, int index) {
  gltf_count(file, index);
  const Accessor& accessor = file.at(file.model.accessors, index, "accessor");
  const bool whole = accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                     accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
                     accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
  if (!whole || accessor.normalized) {
    throw file.error("has indices that are not unsigned integers");
  }
  return all_numbers<std::uint32_t>(file, accessor);
}

}  // namespace ergodome
