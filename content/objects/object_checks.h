#pragma once

#include <optional>
#include <string>

#include "content/files/toml_table.h"
#include "content/show/show.h"

namespace ergodome {

//! Why the method "polygon" cannot draw a show's objects, and the remedy.
struct PolygonLimit {
  std::string problem;
  std::string remedy;
};

//! Returns the reason why polygons cannot draw the show's objects; nothing if they can.
std::optional<PolygonLimit> polygon_limit(const Show& show);

//! Throws Error if the objects of a show use different methods, if lit objects have no light, or if
//! polygon_limit() applies. The hole, the camera and the light must have been read.
void check_objects(const TomlTable& root, const Show& show);

}  // namespace ergodome
