#pragma once

#include <string>
#include <string_view>

namespace ergodome {

//! Checks the JSON of a glTF file before it is parsed: limits on nesting, objects and values keep
//! stack and memory from overflowing. Throws Error if it exceeds them or is not JSON.
void require_bounded_gltf(std::string_view json, const std::string& location);

}  // namespace ergodome
