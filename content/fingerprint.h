#pragma once

#include <string>
#include <string_view>

namespace ergodome {

//! Sixteen hexadecimal digits that tell texts apart (XXH3, 64 bits): not against somebody who means it.
std::string fingerprint(std::string_view text);

}  // namespace ergodome
