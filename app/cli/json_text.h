#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace ergodome {

//! Formats a summary as JSON. Invalid UTF-8, such as in file names, becomes replacement characters.
inline std::string json_text(const nlohmann::json& facts) {
  return facts.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace ergodome
