#pragma once

#include <optional>
#include <string>

#include "content/files/toml_table.h"
#include "content/show/show.h"

namespace ergodome {

//! Reads [[objects]] and [light]. Throws Error with file, line and key.
void read_objects(TomlTable& root, const std::string& file, Show& show);

//! Why polygons cannot show a show's objects, and what can be done.
struct PolygonLimit {
  std::string problem;
  std::string remedy;
};

//! Nothing where they can.
std::optional<PolygonLimit> polygon_limit(const Show& show);

//! Throws Error where the show's hole, camera or light are not such that its objects could be drawn. All of these must have been read.
void check_objects(const TomlTable& root, const Show& show);

//! Writes both into a show's table.
void add_objects(const Show& show, toml::table& root);

}  // namespace ergodome
