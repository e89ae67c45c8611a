#pragma once

#include <string>
#include <string_view>

namespace ergodome {

//! Checks the JSON of a glTF file before it is parsed: nesting, objects and values within limits, so that neither the stack
//! nor the memory overflows. Throws Error where it exceeds them or is no JSON.
void require_bounded_gltf(std::string_view json, const std::string& place);

}  // namespace ergodome
