#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace ergodome {

//! Facts as JSON for people and programs. What is no UTF-8 in names of a person's files becomes the character that stands for such.
inline std::string json_text(const nlohmann::json& facts) {
  return facts.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace ergodome
