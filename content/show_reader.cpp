#include "content/show_reader.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

#include "content/animated_show.h"
#include "content/disk_reader.h"
#include "content/effects_reader.h"
#include "content/files/toml_table.h"
#include "content/flight_reader.h"
#include "content/objects/object_reader.h"
#include "content/own_number.h"
#include "content/shell_reader.h"
#include "content/timeline_reader.h"
#include "content/view_reader.h"
#include "kernels/core/angles.h"

namespace ergodome {

namespace {

constexpr double largest_camera_angle_deg = 1e9;
constexpr std::size_t largest_mib = 16;
constexpr std::size_t most_keys = 100'000;

Vector3<double> read_vector(TomlTable& table, std::string_view key, const toml::node& node) {
  const toml::array* list = node.as_array();
  Vector3<double> v{};
  double* const parts[3] = {&v.x, &v.y, &v.z};
  if (list == nullptr || list->size() != 3) {
    throw table.error_at(key, "is not a direction", "write three numbers: [e_r, e_theta, e_phi]");
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const auto part = list->get(i)->value<double>();
    if (!part || !std::isfinite(*part) || std::abs(*part) > 1e100) {
      throw table.error_at(key, "holds something that is not a number", "write three numbers");
    }
    *parts[i] = *part;
  }
  if (!(dot(v, v) > 0.0)) {
    throw table.error_at(key, "has no length", "write a direction that is not zero");
  }
  return v;
}

void read_observer(TomlTable& camera, const std::string& file, CameraSettings& settings) {
  const toml::node* at = camera.node("observer");
  if (at != nullptr && at->is_table()) {
    TomlTable velocity(*at->as_table(), file, camera.path_of("observer"));
    const double beta = velocity.number("beta", 0.0, 0.0, 1.0);
    if (!(beta <= fastest_observer)) {
      throw velocity.error_at("beta", "is the speed of light", "choose a speed up to 0.999999");
    }
    const toml::node* toward = velocity.node("toward");
    if (toward == nullptr) {
      throw velocity.error_at("toward", "is missing", "write toward = [e_r, e_theta, e_phi]");
    }
    const Vector3<double> v = read_vector(velocity, "toward", *toward);
    settings.motion = ObserverMotion::velocity;
    settings.velocity = (beta / std::sqrt(dot(v, v))) * v;
    velocity.refuse_unknown_keys();
    return;
  }
  constexpr ObserverMotion motions[] = {ObserverMotion::zamo, ObserverMotion::fixed, ObserverMotion::geodesic,
                                        ObserverMotion::retrograde, ObserverMotion::rain};
  settings.motion = motions[camera.choice("observer", 0, {"zamo", "static", "geodesic", "retrograde", "rain"})];
}

CameraKey read_key(TomlTable& table) {
  CameraKey key;
  key.time_s = table.number("t_s", 0.0, -1e12, 1e12);
  key.r = table.number("r", 10.0, 0.0, 1e9);
  key.theta = one_degree * table.number("theta_deg", 90.0, 0.0, 180.0);
  key.phi = one_degree * table.number("phi_deg", 0.0, -largest_camera_angle_deg, largest_camera_angle_deg);
  key.yaw = one_degree * table.number("yaw_deg", 0.0, -largest_camera_angle_deg, largest_camera_angle_deg);
  key.pitch = one_degree * table.number("pitch_deg", 0.0, -largest_camera_angle_deg, largest_camera_angle_deg);
  key.roll = one_degree * table.number("roll_deg", 0.0, -largest_camera_angle_deg, largest_camera_angle_deg);
  const toml::node* look = table.node("look");
  if (look != nullptr && look->is_array()) {
    key.look = {LookTarget::Kind::direction, read_vector(table, "look", *look)};
  } else if (table.choice("look", 0, {"hole", "away"}) == 1) {
    key.look.kind = LookTarget::Kind::away;
  }
  key.hold_s = table.number("hold_s", 0.0, 0.0, 1e12);
  key.ease = static_cast<Ease>(table.choice("ease", 0, {"smooth", "linear", "in", "out", "in_out"}));
  return key;
}

//! A camera must be outside the horizon, and its observer slower than light there.
void check_key(const TomlTable& table, double spin, const CameraSettings& camera, const CameraKey& key) {
  const double horizon = horizon_radius(spin);
  if (!(key.r > horizon)) {
    throw table.error_at("r", fmt::format("is {} M, inside the horizon at {:.6g} M", key.r, horizon),
                         fmt::format("choose r above {:.6g}", horizon));
  }
  const Vector3<double> v = observer_velocity(camera.motion, spin, key.r, key.theta, camera.velocity);
  if (!(dot(v, v) < 1.0) && camera.motion != ObserverMotion::rain) {
    const bool fixed = camera.motion == ObserverMotion::fixed;
    throw table.error_at(
        "r", fmt::format("is {} M, where {} observer would outrun light", key.r, fixed ? "a static" : "an orbiting"),
        fixed ? fmt::format("stay above {:.6g} M or choose observer = \"zamo\"", static_limit_radius(spin, key.theta))
              : "stay outside the photon orbit or choose observer = \"zamo\"");
  }
}

void read_camera(const toml::table* table, const std::string& file, Show& show) {
  const toml::table empty;
  TomlTable camera(table != nullptr ? *table : empty, file, "camera");
  read_observer(camera, file, show.camera);
  const auto keys = camera.tables("key", most_keys);
  if (keys.empty()) {
    throw camera.error_at("key", "is missing",
                          "give the camera at least one [[camera.key]] with r, theta_deg and phi_deg");
  }
  for (std::size_t i = 0; i < keys.size(); ++i) {
    TomlTable each(*keys[i], file, fmt::format("camera.key[{}]", i));
    const CameraKey key = read_key(each);
    if (!each.has("r")) {
      throw each.error_at("r", "is missing", "write the camera's radius in units of M");
    }
    if (i > 0 && !(key.time_s - show.camera.keys.back().time_s >= least_key_gap_s)) {
      throw each.error_at("t_s", "does not come after the key before", "put the keys in order of time");
    }
    if (i > 0 && !(key.time_s - show.camera.keys.back().time_s - show.camera.keys.back().hold_s >= least_key_gap_s)) {
      throw each.error_at("t_s", "comes before the camera has left the key before",
                          "shorten its hold_s, or put this key later");
    }
    check_key(each, spin_at(show, key.time_s), show.camera, key);
    each.refuse_unknown_keys();
    show.camera.keys.push_back(key);
  }
  camera.refuse_unknown_keys();
}

void read_sky(const toml::table& table, const std::string& file, SkySettings& sky) {
  TomlTable reader(table, file, "sky");
  sky.map = reader.text("map", sky.map);
  sky.stars = reader.text("stars", sky.stars);
  sky.faintest_mag = own_number(reader, "faintest_mag", sky.faintest_mag);
  sky.exposure = own_number(reader, "exposure", sky.exposure);
  sky.filter = static_cast<SkyFilter>(reader.choice("filter", 0, {"ewa", "point", "polygon"}));
  constexpr SkyShift shifts[] = {SkyShift::luminance, SkyShift::blackbody_fit};
  sky.shift = shifts[reader.choice("shift", 0, {"luminance", "blackbody_fit"})];
  sky.brightening = reader.boolean("brightening", false);
  if (const toml::table* axis = reader.table("spin_axis")) {
    TomlTable direction(*axis, file, "sky.spin_axis");
    sky.spin_axis_ra_deg = own_number(direction, "ra_deg", sky.spin_axis_ra_deg);
    sky.spin_axis_dec_deg = own_number(direction, "dec_deg", sky.spin_axis_dec_deg);
    direction.refuse_unknown_keys();
  }
  reader.refuse_unknown_keys();
}

void read_stereo(const toml::table& table, const std::string& file, StereoSettings& stereo) {
  TomlTable reader(table, file, "stereo");
  stereo.layout = static_cast<StereoLayout>(
      reader.choice("layout", 0,
                    {"mono", "side_by_side", "top_bottom", "separate", "multiview", "anaglyph", "dubois", "rows",
                     "quad_buffer", "half_side_by_side", "half_top_bottom"}));
  stereo.model = static_cast<StereoModel>(reader.choice("model", 0, {"physical", "flat", "omni"}));
  stereo.baseline = own_number(reader, "baseline", 0.0);
  if (reader.has("convergence")) {
    stereo.convergence = own_number(reader, "convergence", 0.0);
  }
  if (const toml::table* fade = reader.table("fade")) {
    TomlTable angles(*fade, file, "stereo.fade");
    stereo.fade_from_deg = own_number(angles, "from_deg", stereo.fade_from_deg);
    stereo.fade_to_deg = own_number(angles, "to_deg", stereo.fade_to_deg);
    if (!(stereo.fade_to_deg - stereo.fade_from_deg >= least_fade_deg)) {
      throw angles.error_at("to_deg", "does not lie above from_deg", "leave the baseline a degree or more to fade in");
    }
    angles.refuse_unknown_keys();
  }
  stereo.comfort_deg = reader.number("comfort_deg", stereo.comfort_deg, 1e-3, 180.0);
  stereo.swap_eyes = reader.boolean("swap_eyes", false);
  stereo.tint_eyes = reader.boolean("tint_eyes", false);
  reader.refuse_unknown_keys();
}

void read_parts(TomlTable& root, const std::string& file, Show& show) {
  const auto part = [&](std::string_view key, auto read) {
    if (const toml::table* table = root.table(key)) {
      read(*table);
    }
  };
  part("hole", [&](const toml::table& table) {
    TomlTable hole(table, file, "hole");
    show.spin = own_number(hole, "spin", 0.0);
    hole.refuse_unknown_keys();
  });
  part("sky", [&](const toml::table& table) { read_sky(table, file, show.sky); });
  part("stars", [&](const toml::table& table) {
    TomlTable stars(table, file, "stars");
    show.sky.star_method = static_cast<StarMethod>(stars.choice("method", 0, {"inverse", "gather"}));
    stars.refuse_unknown_keys();
  });
  part("disk", [&](const toml::table& table) { show.disk = read_disk(table, file); });
  show.shells = read_shells(root, file);
  part("effects", [&](const toml::table& table) { read_effects(table, file, show.effects); });
  part("view", [&](const toml::table& table) { read_view(table, file, show.view); });
  part("stereo", [&](const toml::table& table) { read_stereo(table, file, show.stereo); });
  part("tone", [&](const toml::table& table) { read_tone(table, file, show.tone); });
  part("flight", [&](const toml::table& table) { read_flight(table, file, show.flight); });
  part("grid", [&](const toml::table& table) {
    TomlTable grid(table, file, "grid");
    show.grid_scheme = static_cast<GridScheme>(grid.choice("scheme", 0, {"conforming", "quadtree"}));
    grid.refuse_unknown_keys();
  });
  part("quality", [&](const toml::table& table) {
    TomlTable quality(table, file, "quality");
    show.quality.budget_px = quality.number("budget_px", show.quality.budget_px, 1e-6, 100.0);
    quality.refuse_unknown_keys();
  });
  read_objects(root, file, show);
  // Of these numbers' limits, and of the spin that the camera meets.
  read_timeline(root, file, show);
  read_camera(root.table("camera"), file, show);
  check_spin_on_path(file, show);
  check_objects(root, show);
  part("disk", [&](const toml::table& table) { check_disk(table, file, show); });
  check_shells(root, file, show);
}

//! Notes where the words of tables stand that a show has several of ("shells[1].texture"): they name files.
void note_words(const toml::array& tables, const std::string& path, std::map<std::string, int>& lines) {
  for (std::size_t i = 0; i < tables.size(); ++i) {
    if (const toml::table* table = tables[i].as_table()) {
      for (const auto& [key, node] : *table) {
        if (node.is_string()) {
          lines[fmt::format("{}[{}].{}", path, i, key.str())] = static_cast<int>(node.source().begin.line);
        }
      }
    }
  }
}

//! Notes where each key of a table stands.
void note_lines(const toml::table& table, const std::string& path, std::map<std::string, int>& lines) {
  for (const auto& [key, node] : table) {
    const std::string own = path.empty() ? std::string(key.str()) : fmt::format("{}.{}", path, key.str());
    lines[own] = static_cast<int>(node.source().begin.line);
    if (const toml::table* below = node.as_table()) {
      note_lines(*below, own, lines);
    } else if (const toml::array* several = node.as_array(); several != nullptr && path.empty()) {
      note_words(*several, own, lines);
    }
  }
}

}  // namespace

Show parse_show(std::string_view text, const std::string& file) {
  const toml::table parsed = parse_toml(text, file, largest_mib, "a show");
  Show show;
  note_lines(parsed, "", show.lines);
  const std::filesystem::path path(file);
  show.name = path.stem().string();
  show.folder = path.parent_path().string();
  TomlTable root(parsed, file, "");
  show.title = root.text("title", show.name);
  show.duration_s = root.number("duration_s", 0.0, 0.0, 1e9);
  show.frame_rate_hz = root.number("frame_rate_hz", 30.0, 0.001, 1000.0);
  read_parts(root, file, show);
  root.refuse_unknown_keys();
  return show;
}

Show read_show(const std::filesystem::path& path) {
  std::error_code problem;
  if (!std::filesystem::is_regular_file(path, problem)) {
    throw Error(path.string(), "is not a file that can be read", "give the path of a show (.toml)");
  }
  if (std::filesystem::file_size(path, problem) > (largest_mib << 20U) || problem) {
    throw Error(path.string(), "is larger than 16 MiB", "a show is a short text file");
  }
  std::ifstream file(path, std::ios::binary);
  std::stringstream text;
  text << file.rdbuf();
  if (!file) {
    throw Error(path.string(), "cannot be read", "check its permissions");
  }
  return parse_show(text.str(), path.string());
}

}  // namespace ergodome
