#pragma once

#include <string>

#include "content/files/toml_table.h"
#include "content/show/show.h"

namespace ergodome {

//! Reads [camera.fall], before the animation of its clock is read; does nothing if it is absent. A
//! velocity that is the observer's is set later. Throws Error with file, line and key for invalid
//! values.
void read_fall(const toml::table* camera, const std::string& file, Show& show);

//! Sets the position of a key during a fall to that of the previous key, because such keys only
//! define the orientation. Throws Error if its table has a position.
void take_position_of_fall(const TomlTable& table, const CameraKey& before, CameraKey& key);

//! Computes the fall of a camera whose keys, and all other numbers of the show, have been read.
//! Throws Error if there is no key when it begins, if it would begin faster than light or lead into
//! the hole, or if it cannot be computed.
void let_fall(const toml::table& fall, const std::string& file, Show& show);

//! Throws Error if the camera falls through the horizon but the show has features that cannot be
//! shown from there: objects with the method "polygon", or the stereo model "flat".
void check_sights_within(TomlTable& root, const std::string& file, const Show& show);

}  // namespace ergodome
