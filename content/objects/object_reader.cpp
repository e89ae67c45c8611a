#include "content/objects/object_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "content/fall/free_fall.h"
#include "content/show/animated_show.h"
#include "kernels/core/angles.h"

namespace ergodome {

namespace {

constexpr double largest_angle_deg = 1e6;
constexpr std::size_t most_objects = 256;
constexpr std::size_t most_way_keys = 10'000;

Vector3<double> read_vector(TomlTable& table, std::string_view key, const Vector3<double>& otherwise, double least,
                            double greatest) {
  const std::vector<double> parts = table.numbers(key, 3, 3, least, greatest);
  return parts.empty() ? otherwise : Vector3<double>{parts[0], parts[1], parts[2]};
}

Vector3<double> read_place(TomlTable& table, std::string_view key) {
  return read_vector(table, key, {0.0, 0.0, 0.0}, -farthest_of_objects, farthest_of_objects);
}

void read_triangle(TomlTable& table, TriangleShape& shape) {
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
}

void read_disk_shape(TomlTable& table, DiskShape& shape) {
  shape.inner = table.number("inner", shape.inner, 1e-6, farthest_of_objects);
  shape.outer = table.number("outer", shape.outer, 1e-6, farthest_of_objects);
  shape.thickness = table.number("thickness", shape.thickness, 1e-6, farthest_of_objects);
  shape.segments = table.integer("segments", shape.segments, fewest_segments, most_segments);
  shape.rings = table.integer("rings", shape.rings, 1, most_rings);
  if (!(shape.outer > shape.inner)) {
    throw table.has("outer") ? table.error_at("outer", fmt::format("is {}, but inner is {}", shape.outer, shape.inner),
                                              "choose an outer radius beyond the inner one")
                             : table.error_at("inner", fmt::format("is {}, but outer is {}", shape.inner, shape.outer),
                                              "choose an outer radius beyond the inner one");
  }
}

void read_form(TomlTable& table, ObjectSettings& object) {
  object.mesh = table.text("mesh", "");
  if (!object.mesh.empty()) {
    if (table.has("shape")) {
      throw table.error_at("shape", "cannot be combined with mesh", "write only one of the two");
    }
    object.form = ObjectForm::mesh;
    return;
  }
  if (!table.has("shape")) {
    throw table.error_at("shape", "is missing", "write shape = \"sphere\", or mesh with the path of a mesh file");
  }
  object.form = static_cast<ObjectForm>(1 + table.choice("shape", 0, {"triangle", "sphere", "disk"}));
  switch (object.form) {
    case ObjectForm::triangle:
      return read_triangle(table, object.triangle);
    case ObjectForm::disk:
      return read_disk_shape(table, object.disk);
    default:
      object.sphere.segments = table.integer("segments", object.sphere.segments, fewest_segments, most_segments);
      object.sphere.rings = table.integer("rings", object.sphere.rings, 2, most_rings);
  }
}

ObjectOrbit read_orbit(const toml::table& from, const std::string& file, const std::string& path) {
  TomlTable table(from, file, path);
  ObjectOrbit orbit;
  orbit.r = table.number("r", orbit.r, nearest_of_observers, farthest_of_objects);
  orbit.phi = one_degree * table.number("phi_deg", 0.0, -largest_angle_deg, largest_angle_deg);
  orbit.inclination = one_degree * table.number("inclination_deg", 0.0, -180.0, 180.0);
  orbit.node = one_degree * table.number("node_deg", 0.0, -360.0, 360.0);
  orbit.speed = table.number("speed", orbit.speed, -1e6, 1e6);
  table.refuse_unknown_keys();
  return orbit;
}

void read_way(TomlTable& table, const std::string& file, std::array<Animation, 3>& way) {
  if (table.has("key") && table.tables("key", most_way_keys).empty()) {
    throw table.error_at("key", "is an empty list",
                         "write [{ t_s = 0, position = [10, 0, 0] }], or position in place of it");
  }
  for (const toml::table* each : table.tables("key", most_way_keys)) {
    TomlTable reader(*each, file, fmt::format("{}[{}]", table.path_of("key"), way[0].keys.size()));
    const double time_s = reader.number("t_s", 0.0, -1e12, 1e12);
    if (!reader.has("position")) {
      throw reader.error_at("position", "is missing", "write { t_s = 0, position = [10, 0, 0] }");
    }
    const Vector3<double> place = read_place(reader, "position");
    const auto ease = static_cast<Ease>(reader.choice("ease", 0, {"smooth", "linear", "in", "out", "in_out", "hold"}));
    if (!way[0].keys.empty() && !(time_s - way[0].keys.back().time_s >= least_key_gap_s)) {
      throw reader.error_at("t_s", "is not later than that of the previous key", "sort the keys by time");
    }
    reader.refuse_unknown_keys();
    const double parts[3] = {place.x, place.y, place.z};
    for (std::size_t i = 0; i < 3; ++i) {
      way[i].keys.push_back({time_s, parts[i], ease});
    }
  }
}

//! Reads the motion of an object. Throws Error unless exactly one of `position`, `orbit` and `key`
//! is given.
void read_motion(TomlTable& table, const std::string& file, ObjectSettings& object) {
  object.position = read_place(table, "position");
  if (const toml::table* const orbit = table.table("orbit")) {
    object.orbit = read_orbit(*orbit, file, table.path_of("orbit"));
  }
  read_way(table, file, object.way);
  const int ways = static_cast<int>(table.has("position")) + static_cast<int>(table.has("orbit")) +
                   static_cast<int>(table.has("key"));
  if (ways > 1) {
    throw table.error_at(table.has("orbit") ? "orbit" : "key", "gives the object a second position",
                         "write only one of position, orbit and key");
  }
}

void read_look(TomlTable& table, const std::string& file, ObjectSettings& object) {
  object.color = read_vector(table, "color", object.color, 0.0, 1e6);
  object.exposure = table.number("exposure", 1.0, 0.0, 1e12);
  object.lit = table.choice("light", 0, {"emissive", "lambert"}) == 1;
  if (const toml::table* const from = table.table("checker")) {
    TomlTable checker(*from, file, table.path_of("checker"));
    CheckerSettings& settings = object.checker.emplace();
    settings.columns = checker.integer("columns", settings.columns, 1, 10'000);
    settings.rows = checker.integer("rows", settings.rows, 1, 10'000);
    settings.dark = checker.number("dark", settings.dark, 0.0, 1.0);
    checker.refuse_unknown_keys();
  }
  if (const toml::table* const from = table.table("tessellation")) {
    TomlTable tessellation(*from, file, table.path_of("tessellation"));
    object.tessellation.most = tessellation.number("most", object.tessellation.most, 1.0, 64.0);
    object.tessellation.factor = tessellation.number("factor", object.tessellation.factor, 0.0, 1e6);
    object.tessellation.power = tessellation.number("power", object.tessellation.power, 0.0, 10.0);
    object.torn = tessellation.number("torn", object.torn, 1.0, 1e9);
    tessellation.refuse_unknown_keys();
  }
  object.method = static_cast<ObjectMethod>(table.choice("method", 0, {"polygon", "trace"}));
  object.retarded = table.boolean("retarded", false);
  object.images = table.integer("images", object.images, 1, most_polygon_images);
}

//! Throws Error for `images` with rays, which find every image.
void check_images(const TomlTable& table, const ObjectSettings& object) {
  if (object.method == ObjectMethod::trace && table.has("images")) {
    throw table.error_at("images", "is used only with method = \"polygon\"; method = \"trace\" finds all images",
                         "remove it, or write method = \"polygon\"");
  }
}

//! Throws Error if light travel time is used without ray tracing, or with keys in the show's time.
void check_retarded(const TomlTable& table, const ObjectSettings& object) {
  if (!object.retarded) {
    return;
  }
  if (object.method != ObjectMethod::trace) {
    throw table.error_at("retarded", "cannot be used with method = \"polygon\"", "write method = \"trace\"");
  }
  if (!object.way[0].keys.empty()) {
    throw table.error_at("retarded", "needs a motion in the time of the hole, but keys use the time of the show",
                         "write orbit = { r = 10, speed = 20 } in place of the keys");
  }
}

ObjectSettings read_object(const toml::table& from, const std::string& file, std::size_t number) {
  TomlTable table(from, file, fmt::format("objects[{}]", number));
  ObjectSettings object;
  read_form(table, object);
  object.size = table.number("size", 1.0, 1e-9, farthest_of_objects);
  const Vector3<double> turn_deg = read_vector(table, "turn_deg", {}, -largest_angle_deg, largest_angle_deg);
  object.turn = one_degree * turn_deg;
  read_motion(table, file, object);
  read_look(table, file, object);
  check_retarded(table, object);
  check_images(table, object);
  table.refuse_unknown_keys();
  return object;
}

double length(const Vector3<double>& v) { return std::sqrt(dot(v, v)); }

}  // namespace

void read_objects(TomlTable& root, const std::string& file, Show& show) {
  for (const toml::table* each : root.tables("objects", most_objects)) {
    show.objects.push_back(read_object(*each, file, show.objects.size()));
    if (show.objects.back().orbit) {
      show.objects.back().orbit->spin = show.spin;
    }
  }
  if (const toml::table* const from = root.table("light")) {
    TomlTable table(*from, file, "light");
    show.light.emplace();
    show.light->position = read_place(table, "position");
    show.light->strength = table.number("strength", 1.0, 0.0, 1e12);
    show.light->falloff = static_cast<LampFalloff>(table.choice("falloff", 0, {"lens", "published"}));
    if (!(length(show.light->position) > nearest_of_observers)) {
      throw table.error_at(table.has("position") ? "position" : "strength", "puts the light inside the photon sphere",
                           "choose a position more than 3 M from the center of the hole");
    }
    table.refuse_unknown_keys();
  }
}

std::optional<PolygonLimit> polygon_limit(const Show& show) {
  if (show.spin != 0.0 || find_animation(show, "hole.spin") != nullptr) {
    return PolygonLimit{"are drawn with method = \"polygon\", which supports only a hole without spin (Schwarzschild)",
                        "write method = \"trace\", or set spin = 0 in [hole] and do not animate it"};
  }
  for (const CameraKey& key : show.camera.keys) {
    if (!(key.r > nearest_of_observers)) {
      return PolygonLimit{fmt::format("are drawn with method = \"polygon\", which needs a camera outside the photon "
                                      "sphere (camera at r = {} M)",
                                      key.r),
                          "keep the camera farther out than 3 M, or write method = \"trace\""};
    }
  }
  if (show.camera.orbit && !(show.camera.orbit->least_r() > nearest_of_observers)) {
    return PolygonLimit{fmt::format("are drawn with method = \"polygon\", which needs a camera outside the photon "
                                    "sphere (it falls to r = {:.6g} M)",
                                    show.camera.orbit->least_r()),
                        "keep the camera farther out than 3 M, or write method = \"trace\""};
  }
  return std::nullopt;
}

void check_objects(const TomlTable& root, const Show& show) {
  if (show.objects.empty()) {
    return;
  }
  if (!show.light && std::ranges::any_of(show.objects, &ObjectSettings::lit)) {
    throw root.error_at("objects", "have light = \"lambert\", but the show has no [light]",
                        "add [light] with position = [x, y, z] and strength");
  }
  const ObjectMethod method = show.objects.front().method;
  if (!std::ranges::all_of(show.objects, [&](const ObjectSettings& each) { return each.method == method; })) {
    throw root.error_at("objects", "use two different methods", "write the same method for all of them");
  }
  if (method == ObjectMethod::trace) {
    return;
  }
  if (const std::optional<PolygonLimit> limit = polygon_limit(show)) {
    throw root.error_at("objects", limit->problem, limit->remedy);
  }
}

}  // namespace ergodome
