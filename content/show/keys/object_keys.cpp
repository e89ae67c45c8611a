#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "content/show/key_table.h"
#include "content/show/show_schema.h"

namespace ergodome {

namespace {

constexpr double largest_angle_deg = 1e6;
constexpr std::size_t max_object_keys = 10'000;

constexpr std::array shape_names = {"triangle", "sphere", "disk"};
constexpr std::array falloff_names = {"lens", "published"};

toml::array array_of(const Vector3<double>& v) { return toml::array{v.x, v.y, v.z}; }

template <ObjectForm Form>
constexpr auto only_for = [](const ObjectSettings& object) { return object.form == Form; };

constexpr auto read_corners = [](TomlTable& table, TriangleShape& shape) {
  const toml::node* const node = table.node("corners");
  if (node == nullptr) {
    return;
  }
  const toml::array* const corners = node->as_array();
  const auto wrong = [&] {
    return table.error_at("corners", "are not three positions", "write [[0, 0, 0], [0, 1, 0], [0, 0, 1]]");
  };
  if (corners == nullptr || corners->size() != 3) {
    throw wrong();
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const toml::array* const corner = corners->get(i)->as_array();
    if (corner == nullptr || corner->size() != 3) {
      throw wrong();
    }
    double part[3] = {};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto value = corner->get(k)->value<double>();
      if (!value || !(std::abs(*value) <= farthest_of_objects)) {
        throw wrong();
      }
      part[k] = *value;
    }
    shape.corners[i] = {part[0], part[1], part[2]};
  }
};

constexpr auto write_corners = [](toml::table& table, const TriangleShape& shape) {
  table.insert("corners",
               toml::array{array_of(shape.corners[0]), array_of(shape.corners[1]), array_of(shape.corners[2])});
};

constexpr auto check_edges = [](const TomlTable& table, const DiskShape& shape) {
  if (!(shape.outer > shape.inner)) {
    throw table.has("outer") ? table.error_at("outer", fmt::format("is {}, but inner is {}", shape.outer, shape.inner),
                                              "choose an outer radius beyond the inner one")
                             : table.error_at("inner", fmt::format("is {}, but outer is {}", shape.inner, shape.outer),
                                              "choose an outer radius beyond the inner one");
  }
};

constexpr auto triangle_keys =
    keys_of<TriangleShape>(other<TriangleShape>("corners", "The three corners. They must not lie on one line.")
                               .by(read_corners, write_corners)
                               .page({.type = "list of 3 positions",
                                      .unit = "mesh unit",
                                      .otherwise = "`[[0, 0, 0], [0, 1, 0], [0, 0, 1]]`",
                                      .bounds = "-1e5 to 1e5 each"}));

constexpr auto sphere_keys = keys_of<SphereShape>(
    key<&SphereShape::segments>("segments", "Divisions in longitude.").range(min_segments, max_segments),
    key<&SphereShape::rings>("rings", "Divisions in latitude.").range(2, max_rings));

constexpr auto disk_shape_keys = keys_of<DiskShape>(
    key<&DiskShape::inner>("inner", "Inner radius.").range(1e-6, farthest_of_objects, "mesh unit"),
    key<&DiskShape::outer>("outer", "Outer radius.")
        .range(1e-6, farthest_of_objects, "mesh unit")
        .after(check_edges)
        .page({.bounds = "1e-6 to 1e5, above `inner`"}),
    key<&DiskShape::thickness>("thickness", "Thickness.").range(1e-6, farthest_of_objects, "mesh unit"),
    key<&DiskShape::segments>("segments", "Divisions around the axis.").range(min_segments, max_segments),
    key<&DiskShape::rings>("rings", "Divisions of each face from the inner to the outer edge.").range(1, max_rings));

constexpr auto orbit_keys = keys_of<ObjectOrbit>(
    key<&ObjectOrbit::r>("r", "Radius.").range(nearest_of_observers, farthest_of_objects, "M"),
    key<&ObjectOrbit::phi>("phi_deg", "Position on the orbit at time 0, counted from the ascending node.")
        .degrees(-largest_angle_deg, largest_angle_deg),
    key<&ObjectOrbit::inclination>("inclination_deg", "Inclination to the plane z = 0.").degrees(-180.0, 180.0),
    key<&ObjectOrbit::node>("node_deg", "Azimuth of the ascending node, where the object rises through z = 0.")
        .degrees(-360.0, 360.0),
    key<&ObjectOrbit::speed>("speed", "M of the hole's time in one second of the show. Negative: backward.")
        .range(-1e6, 1e6, "M/s"));

constexpr auto object_key_keys = keys_of<ObjectKey>(
    key<&ObjectKey::time_s>("t_s", "Time of the show. Entries are in order of time, at least 1e-6 s apart.")
        .range(-1e12, 1e12, "s"),
    key<&ObjectKey::position>("position", "[Position](#coordinates) at that time.")
        .range(-farthest_of_objects, farthest_of_objects, "M")
        .required("write { t_s = 0, position = [10, 0, 0] }")
        .page({.type = "position"}),
    key<&ObjectKey::ease>("ease", "Motion to the next entry.")
        .words(ease_names)
        .page({.bounds = "see [easing](show-keys.md#easing)"}));

constexpr auto check_keys = [](TomlTable& table, const ObjectSettings& object) {
  if (table.has("key") && object.keys.empty()) {
    throw table.error_at("key", "is an empty list",
                         "write [{ t_s = 0, position = [10, 0, 0] }], or position in place of it");
  }
  const auto tables = table.tables("key", max_object_keys);
  for (std::size_t i = 1; i < tables.size(); ++i) {
    if (!(object.keys[i].time_s - object.keys[i - 1].time_s >= min_key_gap_s)) {
      throw table.below(*tables[i], fmt::format("key[{}]", i))
          .error_at("t_s", "is not later than that of the previous key", "sort the keys by time");
    }
  }
};

constexpr auto check_motion = [](TomlTable& table, const ObjectSettings& object) {
  check_keys(table, object);
  const int motions = static_cast<int>(table.has("position")) + static_cast<int>(table.has("orbit")) +
                      static_cast<int>(table.has("key"));
  if (motions > 1) {
    throw table.error_at(table.has("orbit") ? "orbit" : "key", "gives the object a second position",
                         "write only one of position, orbit and key");
  }
};

constexpr auto check_mesh = [](const TomlTable& table, ObjectSettings& object) {
  if (!object.mesh.empty()) {
    if (table.has("shape")) {
      throw table.error_at("shape", "cannot be combined with mesh", "write only one of the two");
    }
    object.form = ObjectForm::mesh;
  }
};

//! Checks a retarded object: light travel time requires ray tracing, and a motion in the hole's
//! time.
constexpr auto check_retarded = [](const TomlTable& table, const ObjectSettings& object) {
  if (!object.retarded) {
    return;
  }
  if (object.method != ObjectMethod::trace) {
    throw table.error_at("retarded", "cannot be used with method = \"polygon\"", "write method = \"trace\"");
  }
  if (!object.keys.empty()) {
    throw table.error_at("retarded", "needs a motion in the time of the hole, but keys use the time of the show",
                         "write orbit = { r = 10, speed = 20 } in place of the keys");
  }
};

//! Checks that `images` is not set for traced objects, because rays find every image.
constexpr auto check_images = [](const TomlTable& table, const ObjectSettings& object) {
  if (object.method == ObjectMethod::trace && table.has("images")) {
    throw table.error_at("images", "is used only with method = \"polygon\"; method = \"trace\" finds all images",
                         "remove it, or write method = \"polygon\"");
  }
};

constexpr auto checker_keys = keys_of<CheckerSettings>(
    key<&CheckerSettings::columns>("columns", "Columns.").range(1, 10'000),
    key<&CheckerSettings::rows>("rows", "Rows.").range(1, 10'000),
    key<&CheckerSettings::dark>("dark", "Factor on the light of every other field.").range(0.0, 1.0));

constexpr auto tessellation_keys = keys_of<ObjectSettings>(
    key<&ObjectSettings::tessellation, &TessellationSettings::maximum>("most", "Maximum number of parts of an edge.")
        .range(1.0, 64.0),
    key<&ObjectSettings::tessellation, &TessellationSettings::factor>("factor",
                                                                      "Factor on the apparent curvature of an edge.")
        .range(0.0, 1e6),
    key<&ObjectSettings::tessellation, &TessellationSettings::power>("power", "Exponent of the apparent curvature.")
        .range(0.0, 10.0),
    key<&ObjectSettings::torn>("torn", "Triangles whose perimeter grows by more than this factor are left out.")
        .range(1.0, 1e9));

constexpr auto keys_of_object = keys_of<ObjectSettings>(
    key<&ObjectSettings::mesh>("mesh", "Mesh file, relative to the folder of the show.")
        .after(check_mesh)
        .written_if(only_for<ObjectForm::mesh>)
        .page({.type = "path", .otherwise = "none", .bounds = ".obj, .gltf, .glb"}),
    key<&ObjectSettings::form>("shape", "Built-in shape; required without `mesh`.")
        .words(shape_names)
        .first(ObjectForm::triangle)
        .only_if([](const ObjectSettings& object) { return object.form != ObjectForm::mesh; })
        .required("write shape = \"sphere\", or mesh with the path of a mesh file")
        .page({.otherwise = "none"}),
    part<&ObjectSettings::triangle>(triangle_keys).only_if(only_for<ObjectForm::triangle>),
    part<&ObjectSettings::sphere>(sphere_keys).only_if(only_for<ObjectForm::sphere>),
    part<&ObjectSettings::disk>(disk_shape_keys).only_if(only_for<ObjectForm::disk>),
    key<&ObjectSettings::size>("size", "Length of one mesh unit.").range(1e-9, farthest_of_objects, "M"),
    key<&ObjectSettings::turn>("turn_deg", "Rotation about the x axis, then y, then z.")
        .degrees(-largest_angle_deg, largest_angle_deg),
    key<&ObjectSettings::position>("position", "[Position](#coordinates) of the origin of the mesh.")
        .range(-farthest_of_objects, farthest_of_objects, "M")
        .written_if([](const ObjectSettings& object) { return !object.orbit && object.keys.empty(); })
        .page({.type = "position"}),
    table<&ObjectSettings::orbit>("orbit", orbit_keys, "Circular orbit of the origin of the mesh.")
        .page({.otherwise = "none", .bounds = "see below"}),
    table<&ObjectSettings::keys>("key", object_key_keys, "Positions that the object passes.", max_object_keys)
        .after(check_motion)
        .page({.otherwise = "none", .bounds = "1 to 10,000 entries"}),
    key<&ObjectSettings::color>("color", "Factor on the colors of the mesh: red, green, blue in linear light.")
        .range(0.0, 1e6, "display white"),
    key<&ObjectSettings::exposure>("exposure", "Factor on all light of the object.").range(0.0, 1e12),
    table<&ObjectSettings::checker>("checker", checker_keys, "Checkerboard over the texture coordinates.")
        .page({.otherwise = "none", .bounds = "see below"}),
    other<ObjectSettings>("light",
                          "`\"emissive\"`: shines by itself. `\"lambert\"`: diffusely reflects the light of `[light]`, "
                          "which must exist.")
        .by(
            [](TomlTable& table, ObjectSettings& object) {
              object.lit = table.choice("light", 0, {"emissive", "lambert"}) == 1;
            },
            [](toml::table& table, const ObjectSettings& object) {
              table.insert("light", object.lit ? "lambert" : "emissive");
            })
        .page({.type = "word", .otherwise = "`\"emissive\"`", .bounds = "`\"emissive\"`, `\"lambert\"`"}),
    key<&ObjectSettings::method>("method", "[Method](#methods).").words(object_method_names),
    key<&ObjectSettings::retarded>("retarded",
                                   "`true`: [seen where it was](#light-travel-time) when its light left it.")
        .after(check_retarded)
        .unused_if([](const Show& /*show*/, const ObjectSettings& object) {
          return object.orbit ? nullptr : "is used only by objects on an orbit";
        }),
    key<&ObjectSettings::images>("images", "Number of images of the object. For `\"polygon\"` only.")
        .range(1, max_polygon_images)
        .after(check_images)
        .written_if([](const ObjectSettings& object) { return object.method == ObjectMethod::polygon; }),
    group<ObjectSettings>("tessellation", tessellation_keys,
                          "How finely triangles are divided. For `\"polygon\"` only.")
        .unused_if([](const Show& /*show*/, const ObjectSettings& object) {
          // Traced objects do not use this table, except that their diagrams use `torn`.
          return object.method != ObjectMethod::polygon && object.torn == ObjectSettings().torn
                     ? "is used only with method = \"polygon\""
                     : nullptr;
        })
        .page({.otherwise = "see below", .bounds = "see below"}));

constexpr auto keys_of_light = keys_of<PointLight>(
    key<&PointLight::position>("position", "Position, more than 3 M from the center of the hole.")
        .range(-farthest_of_objects, farthest_of_objects, "M")
        .page({.type = "position", .otherwise = "required"}),
    key<&PointLight::strength>("strength",
                               "Strength: a surface at a distance of d that faces the lamp gets `strength`/d².")
        .range(0.0, 1e12, "display white at 1 M"),
    key<&PointLight::falloff>("falloff", "How the light fades near the hole. For `\"trace\"` only.")
        .words(falloff_names)
        .after([](const TomlTable& table, const PointLight& light) {
          if (!(std::sqrt(dot(light.position, light.position)) > nearest_of_observers)) {
            throw table.error_at(table.has("position") ? "position" : "strength",
                                 "puts the light inside the photon sphere",
                                 "choose a position more than 3 M from the center of the hole");
          }
        })
        .unused_if([](const Show& show, const PointLight& light) {
          return std::ranges::any_of(show.objects, &ObjectSettings::lit) && light.falloff == LampFalloff::lens &&
                         show.objects.front().method == ObjectMethod::polygon
                     ? "\"lens\" is used only with method = \"trace\"; polygons use \"published\""
                     : nullptr;
        }));

}  // namespace

constinit const KeyTable<ObjectSettings> object_keys = keys_of_object;
constinit const KeyTable<PointLight> light_keys = keys_of_light;

}  // namespace ergodome
