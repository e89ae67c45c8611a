#pragma once

#include <string>
#include <string_view>

#include "content/files/toml_table.h"
#include "kernels/spacetime/kerr/observer.h"

namespace ergodome {

//! The motion of an observer in a show file: a name, or a velocity in the ZAMO frame.
struct WrittenMotion {
  ObserverMotion motion = ObserverMotion::zamo;
  //! Velocity in the ZAMO frame, for ObserverMotion::velocity.
  Vector3<double> velocity = {0.0, 0.0, 0.0};
};

//! Reads a word such as "rain", or { beta = 0.4, toward = [0, 0, 1] }; returns `otherwise` if the
//! key is absent. Throws Error if the value is invalid.
WrittenMotion read_motion(TomlTable& table, std::string_view key, const std::string& file,
                          const WrittenMotion& otherwise);

//! Returns the word for a motion in show files and metadata: "velocity" for ObserverMotion::velocity.
const char* motion_name(ObserverMotion motion);

//! Reads a direction: three numbers that are not all 0. Throws Error for anything else.
Vector3<double> read_vector(TomlTable& table, std::string_view key, const toml::node& node);

//! Writes a velocity as read_motion() reads it.
void write_motion(toml::table& table, std::string_view key, const WrittenMotion& written);

}  // namespace ergodome
