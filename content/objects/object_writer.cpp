#include <algorithm>

#include "content/objects/object_reader.h"
#include "kernels/core/angles.h"

namespace ergodome {

namespace {

//! Converts radians to degrees, clamped to the range that the reader accepts, as rounding may
//! exceed it.
double degrees_of(double angle, double most) { return std::clamp(angle * radian_deg, -most, most); }

toml::array array_of(const Vector3<double>& v) { return toml::array{v.x, v.y, v.z}; }

//! Adds the keys that are specific to an object's form.
void add_form(const ObjectSettings& object, toml::table& table) {
  switch (object.form) {
    case ObjectForm::mesh:
      table.insert("mesh", object.mesh);
      break;
    case ObjectForm::triangle:
      table.insert("shape", "triangle");
      table.insert("corners", toml::array{array_of(object.triangle.corners[0]), array_of(object.triangle.corners[1]),
                                          array_of(object.triangle.corners[2])});
      break;
    case ObjectForm::sphere:
      table.insert("shape", "sphere");
      table.insert("segments", object.sphere.segments);
      table.insert("rings", object.sphere.rings);
      break;
    case ObjectForm::disk:
      table.insert("shape", "disk");
      table.insert("inner", object.disk.inner);
      table.insert("outer", object.disk.outer);
      table.insert("thickness", object.disk.thickness);
      table.insert("segments", object.disk.segments);
      table.insert("rings", object.disk.rings);
      break;
  }
}

void add_motion(const ObjectSettings& object, toml::table& table) {
  if (object.orbit) {
    table.insert("orbit", toml::table{{"r", object.orbit->r},
                                      {"phi_deg", degrees_of(object.orbit->phi, 1e6)},
                                      {"inclination_deg", degrees_of(object.orbit->inclination, 180.0)},
                                      {"node_deg", degrees_of(object.orbit->node, 360.0)},
                                      {"speed", object.orbit->speed}});
  } else if (!object.way[0].keys.empty()) {
    toml::array keys;
    for (std::size_t i = 0; i < object.way[0].keys.size(); ++i) {
      const NumberKey& key = object.way[0].keys[i];
      keys.push_back(
          toml::table{{"t_s", key.time_s},
                      {"position", toml::array{key.value, object.way[1].keys[i].value, object.way[2].keys[i].value}},
                      {"ease", ease_names[static_cast<std::size_t>(key.ease)]}});
    }
    table.insert("key", std::move(keys));
  } else {
    table.insert("position", array_of(object.position));
  }
}

toml::table table_of(const ObjectSettings& object) {
  toml::table table{{"size", object.size},
                    {"turn_deg", toml::array{degrees_of(object.turn.x, 1e6), degrees_of(object.turn.y, 1e6),
                                             degrees_of(object.turn.z, 1e6)}},
                    {"color", array_of(object.color)},
                    {"exposure", object.exposure},
                    {"light", object.lit ? "lambert" : "emissive"},
                    {"method", object.method == ObjectMethod::trace ? "trace" : "polygon"},
                    {"retarded", object.retarded},
                    {"tessellation", toml::table{{"most", object.tessellation.most},
                                                 {"factor", object.tessellation.factor},
                                                 {"power", object.tessellation.power},
                                                 {"torn", object.torn}}}};
  if (object.method == ObjectMethod::polygon) {
    table.insert("images", object.images);
  }
  add_form(object, table);
  add_motion(object, table);
  if (object.checker) {
    table.insert("checker", toml::table{{"columns", object.checker->columns},
                                        {"rows", object.checker->rows},
                                        {"dark", object.checker->dark}});
  }
  return table;
}

}  // namespace

void add_objects(const Show& show, toml::table& root) {
  if (show.light) {
    root.insert("light", toml::table{{"position", array_of(show.light->position)},
                                     {"strength", show.light->strength},
                                     {"falloff", show.light->falloff == LampFalloff::lens ? "lens" : "published"}});
  }
  if (show.objects.empty()) {
    return;
  }
  toml::array objects;
  for (const ObjectSettings& object : show.objects) {
    objects.push_back(table_of(object));
  }
  root.insert("objects", std::move(objects));
}

}  // namespace ergodome
