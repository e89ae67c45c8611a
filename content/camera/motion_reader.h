#pragma once

#include <string>
#include <string_view>

#include "content/files/toml_table.h"
#include "kernels/spacetime/kerr/observer.h"

namespace ergodome {

//! How an observer moves, as a show says it: by a name, or by a velocity in the ZAMO frame.
struct WrittenMotion {
  ObserverMotion motion = ObserverMotion::zamo;
  Vector3<double> velocity = {0.0, 0.0, 0.0};  //!< for ObserverMotion::velocity
};

//! Reads "rain", or { beta = 0.4, toward = [0, 0, 1] }; `otherwise` where the key is absent. Throws Error for what is no motion.
WrittenMotion read_motion(TomlTable& table, std::string_view key, const std::string& file,
                          const WrittenMotion& otherwise);

//! Reads a direction: three numbers that are not all 0. Throws Error for anything else.
Vector3<double> read_vector(TomlTable& table, std::string_view key, const toml::node& node);

}  // namespace ergodome
