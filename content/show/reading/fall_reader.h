#pragma once

#include <string>

#include "content/files/toml_table.h"
#include "content/show/show.h"

namespace ergodome {

//! Reads [camera.fall] except its velocity, which let_fall() reads; does nothing if it is absent.
//! Call it before read_animations(), which may animate its clock. Throws Error with file, line and
//! key for invalid values.
void read_fall(const toml::table* camera, const std::string& file, Show& show);

//! Sets the position of a key during a fall to that of the previous key, because such keys only
//! define the orientation. Throws Error if its table has a position.
void take_position_of_fall(const TomlTable& table, const CameraKey& before, CameraKey& key);

//! Reads the velocity of the fall, computes its orbit and sets CameraSettings::orbit and
//! after_fall. The camera's keys and all other numbers of the show must have been read. Throws
//! Error if there is no key when it begins, if it would begin faster than light or would reach the
//! horizon without a least_r inside it, or if it cannot be computed up to the show's end.
void let_fall(const toml::table& fall, const std::string& file, Show& show);

//! Throws Error if the camera falls through the horizon but the show has features that cannot be
//! shown from there: objects with the method "polygon", or the stereo model "flat".
void check_sights_within(TomlTable& root, const std::string& file, const Show& show);

}  // namespace ergodome
