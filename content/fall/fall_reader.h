#pragma once

#include <string>

#include "content/files/toml_table.h"
#include "content/show/show.h"

namespace ergodome {

//! Reads [camera.fall], before what animates its clock is read; nothing where the camera has none. Its `velocity` is yet to be known where
//! it is that of the observer. Throws Error with file, line and key.
void read_fall(const toml::table* camera, const std::string& file, Show& show);

//! Gives a key of a fall, which says but where the camera looks, the place of the key before. Throws Error where it has one.
void take_place_of_fall(const TomlTable& table, const CameraKey& before, CameraKey& key);

//! Lets a camera fall whose keys have been read, and all numbers of its show. Throws Error where there is no key when it begins, where
//! it would begin faster than light or lead into the hole, and where it cannot be followed.
void let_fall(const toml::table& fall, const std::string& file, Show& show);

//! Throws Error where the camera falls through the horizon of a show with what cannot be shown from there: objects of the method polygon, eyes of
//! the model flat.
void check_sights_within(TomlTable& root, const std::string& file, const Show& show);

}  // namespace ergodome
