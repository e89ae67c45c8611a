#include "content/show/reading/camera_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "content/camera/camera_path.h"
#include "content/files/toml_table.h"
#include "content/show/animated_show.h"
#include "content/show/key_table.h"
#include "content/show/reading/fall_reader.h"
#include "content/show/reading/motion_reader.h"
#include "content/show/reading/show_reader.h"
#include "content/show/show_schema.h"
#include "kernels/core/angles.h"
#include "kernels/spacetime/kerr/kerr.h"

namespace ergodome {

namespace {

constexpr double largest_camera_angle_deg = 1e9;
constexpr std::size_t max_keys = 100'000;

constexpr std::array camera_eases = {"smooth", "linear", "in", "out", "in_out"};

constexpr auto read_direction = [](TomlTable& table, CameraKey& key) {
  const toml::node* look = table.node("look");
  if (look != nullptr && look->is_array()) {
    key.look = {LookTarget::Kind::direction, read_vector(table, "look", *look)};
  } else if (table.choice("look", 0, {"hole", "away"}) == 1) {
    key.look.kind = LookTarget::Kind::away;
  }
};

constexpr auto write_direction = [](toml::table& table, const CameraKey& key) {
  if (key.look.kind == LookTarget::Kind::direction) {
    table.insert("look", toml::array{key.look.direction.x, key.look.direction.y, key.look.direction.z});
  } else {
    table.insert("look", key.look.kind == LookTarget::Kind::hole ? "hole" : "away");
  }
};

constexpr auto write_velocity = [](toml::table& table, const CameraKey& key) {
  if (key.velocity) {
    write_motion(table, "velocity", {ObserverMotion::velocity, *key.velocity});
  }
};

constexpr auto keys_of_key = keys_of<CameraKey>(
    key<&CameraKey::time_s>("t_s", "Time of the key. Keys are in order of time, at least 1e-6 s apart.")
        .range(-1e12, 1e12, "s"),
    key<&CameraKey::r>("r", "Boyer-Lindquist radius.")
        .range(0.0, 1e9, "M")
        .page({.otherwise = "required", .bounds = "above the horizon, to 1e9", .varies = "by keys"}),
    key<&CameraKey::theta>("theta_deg", "Polar angle from the spin axis. 90 is the equator.")
        .degrees(0.0, 180.0)
        .page({.varies = "by keys"}),
    key<&CameraKey::phi>(
        "phi_deg", "Azimuth. It grows in the direction in which a hole of positive spin turns, and may exceed 360.")
        .degrees(-largest_camera_angle_deg, largest_camera_angle_deg)
        .page({.varies = "by keys"}),
    other<CameraKey>(
        "look",
        "Direction of view before `yaw_deg`, `pitch_deg` and `roll_deg`. The list is a direction of any length "
        "except 0.")
        .by(read_direction, write_direction)
        .page({.type = "word or list of 3 numbers",
               .otherwise = "`\"hole\"`",
               .bounds = "`\"hole\"`, `\"away\"`, `[e_r, e_theta, e_phi]`",
               .varies = "by keys"}),
    key<&CameraKey::yaw>("yaw_deg", "Turns the view to the right.")
        .degrees(-largest_camera_angle_deg, largest_camera_angle_deg)
        .page({.varies = "by keys"}),
    key<&CameraKey::pitch>("pitch_deg", "Turns the view up.")
        .degrees(-largest_camera_angle_deg, largest_camera_angle_deg)
        .page({.varies = "by keys"}),
    key<&CameraKey::roll>("roll_deg", "Rolls the view clockwise.")
        .degrees(-largest_camera_angle_deg, largest_camera_angle_deg)
        .page({.varies = "by keys"}),
    key<&CameraKey::hold_s>("hold_s", "The camera stays at this key for this time, starting at `t_s`.")
        .range(0.0, 1e12, "s")
        .written_if([](const CameraKey& key) { return key.hold_s > 0.0; }),
    key<&CameraKey::ease>("ease", "Motion from this key to the next: [easing](#easing).")
        .words(camera_eases)
        .written_if([](const CameraKey& key) { return key.ease != Ease::smooth; }),
    // take_velocity() reads it, because it depends on the spin.
    other<CameraKey>("velocity", "Velocity of the observer at this key. It replaces `camera.observer`.")
        .by([](TomlTable& table, CameraKey& /*key*/) { table.node("velocity"); }, write_velocity)
        .page({.type = "word or table",
               .otherwise = "absent",
               .bounds = "see [observers](#observers)",
               .varies = "by keys"}));

//! Writes the keys; those during a fall have no position.
constexpr auto write_camera_keys = [](toml::table& table, const CameraSettings& camera) {
  toml::array keys;
  for (const CameraKey& key : camera.keys) {
    toml::table each = written_settings<CameraKey>(keys_of_key, key);
    if (camera.fall && falls_at(*camera.fall, key.time_s)) {
      for (const char* const position : {"r", "theta_deg", "phi_deg"}) {
        each.erase(position);
      }
    }
    keys.push_back(std::move(each));
  }
  table.insert("key", std::move(keys));
};

// read_camera() reads these tables in its own order, because they depend on the animated spin.
constexpr auto read_later = [](TomlTable& /*table*/, CameraSettings& /*camera*/) {};

//! Returns true if the show's observer would have to be faster than light at (r, θ); never for
//! ObserverMotion::rain.
bool outruns_light(const CameraSettings& camera, Spacetime spacetime, double r, double theta) {
  const Vector3<double> v = observer_velocity(camera.motion, spacetime, r, theta, camera.velocity);
  return !(dot(v, v) < 1.0) && camera.motion != ObserverMotion::rain;
}

const char* observer_word(const CameraSettings& camera) {
  return camera.motion == ObserverMotion::fixed ? "a static" : "an orbiting";
}

//! Sets the velocity of a key outside a fall, if its table has one. Throws Error if only some keys
//! have a velocity, if a key has one although the camera's fall has an end, or if the velocity is
//! too close to that of light.
void take_velocity(TomlTable& table, const std::string& file, const Show& show, CameraKey& key) {
  const WrittenMotion written = read_motion(table, "velocity", file, {});
  if (!show.camera.keys.empty() && table.has("velocity") != show.camera.keys.front().velocity.has_value()) {
    throw table.error_at("velocity", table.has("velocity") ? "is missing from the keys before this one" : "is missing",
                         "give either all keys of the camera a velocity, or none");
  }
  if (!table.has("velocity")) {
    return;
  }
  if (show.camera.fall && show.camera.fall->until_s) {
    throw table.error_at("velocity", "cannot be combined with a fall that ends",
                         "remove until_s from [camera.fall], or velocity from all keys");
  }
  const Vector3<double> v =
      observer_velocity(written.motion, spacetime_at(show, key.time_s), key.r, key.theta, written.velocity);
  if (!(dot(v, v) <= fastest_observer * fastest_observer * (1.0 + 1e-12))) {
    throw table.error_at("velocity", fmt::format("would exceed the speed of light at r = {} M", key.r),
                         "move the camera farther out, or write velocity = { beta = 0.3, toward = [0, 0, 1] }");
  }
  key.velocity = v;
}

//! Throws Error unless a key is at least min_key_gap_s later than the previous key and its hold,
//! and than the end of a fall before it.
void check_time(const TomlTable& table, const CameraSettings& camera, const CameraKey& key) {
  if (!camera.keys.empty()) {
    const CameraKey& before = camera.keys.back();
    if (!(key.time_s - before.time_s >= min_key_gap_s)) {
      throw table.error_at("t_s", "is not later than that of the previous key", "sort the keys by time");
    }
    if (!(key.time_s - before.time_s - before.hold_s >= min_key_gap_s)) {
      throw table.error_at("t_s", "is before the end of the previous key's hold",
                           "shorten the hold_s of the previous key, or move this key later");
    }
  }
  const double since_fall_s = camera.fall && camera.fall->until_s ? key.time_s - *camera.fall->until_s : 0.0;
  if (since_fall_s > 0.0 && since_fall_s < min_key_gap_s) {
    throw table.error_at("t_s", "is not later than the end of the fall", "move the key later, or end the fall earlier");
  }
}

//! Throws Error if a key is inside the horizon, or its observer would be faster than light.
void check_key(const TomlTable& table, Spacetime spacetime, const CameraSettings& camera, const CameraKey& key) {
  const double horizon = horizon_radius(spacetime);
  if (!(key.r > horizon)) {
    throw table.error_at("r", fmt::format("is {} M, inside the horizon at {:.6g} M", key.r, horizon),
                         fmt::format("choose r above {:.6g}", horizon));
  }
  if (!key.velocity && outruns_light(camera, spacetime, key.r, key.theta)) {
    throw table.error_at(
        "r",
        fmt::format("is {} M, where {} observer would have to move faster than light", key.r, observer_word(camera)),
        camera.motion == ObserverMotion::fixed ? fmt::format("stay above {:.6g} M, or choose observer = \"zamo\"",
                                                             static_limit_radius(spacetime, key.theta))
                                               : "stay outside the photon orbit, or choose observer = \"zamo\"");
  }
}

//! Throws Error if the observer would be faster than light at a show time. The error names `table`,
//! that of a camera key.
void check_position(const TomlTable& table, const Show& show, double time_s) {
  const CameraPose pose = camera_pose(show, time_s);
  if (outruns_light(show.camera, spacetime_at(show, time_s), pose.r, pose.theta)) {
    throw table.error_at(
        "r",
        fmt::format("leads the camera to r = {:.4g} M and theta = {:.4g} deg at {:.4g} s, where {} observer would "
                    "have to move faster than light",
                    pose.r, radian_deg * pose.theta, time_s, observer_word(show.camera)),
        "keep the camera farther out between the keys, or choose observer = \"zamo\"");
  }
}

//! Throws Error if the observer would be faster than light where a fall ends. The error names the
//! fall's table.
void check_end_of_fall(const TomlTable& fall, const Show& show) {
  if (show.camera.after_fall.empty()) {
    return;
  }
  const CameraKey& end = show.camera.after_fall.front();
  if (outruns_light(show.camera, spacetime_of(show), end.r, end.theta)) {
    throw fall.error_at(
        "until_s",
        fmt::format("ends the fall at r = {:.4g} M, where {} observer would have to move faster than light", end.r,
                    observer_word(show.camera)),
        "end it where the camera is farther out, or choose observer = \"zamo\"");
  }
}

//! Returns the beginning of the path segment to a key outside a fall: the previous key, or the end
//! of the fall.
const CameraKey& key_before(const Show& show, std::size_t i) {
  const CameraKey& before = show.camera.keys[i - 1];
  const std::vector<CameraKey>& after_fall = show.camera.after_fall;
  return !after_fall.empty() && before.time_s <= after_fall.front().time_s &&
                 show.camera.keys[i].time_s > after_fall.front().time_s
             ? after_fall.front()
             : before;
}

//! Throws Error if a static or orbiting observer would be faster than light at one of some sampled
//! times between two camera keys, holds included, or at a key of the animated spin. Skips falls,
//! and cameras whose keys have velocities, which are below that of light.
void check_ways(const std::vector<const toml::table*>& tables, const std::string& file, const Show& show) {
  // Outside this radius no position needs a check: for any spin, static observers are slower than
  // light outside 2 M, orbiting ones outside 4 M.
  constexpr double safe_r = 4.0;
  const ObserverMotion motion = show.camera.motion;
  if (show.camera.keys.front().velocity) {
    return;
  }
  if (motion != ObserverMotion::fixed && motion != ObserverMotion::geodesic && motion != ObserverMotion::retrograde) {
    return;
  }
  const auto table_of = [&](std::size_t key) {
    return TomlTable(*tables[key], file, fmt::format("camera.key[{}]", key));
  };
  const std::vector<CameraKey>& keys = show.camera.keys;
  // Checks fewer positions per segment if there are many keys: these are close together, and
  // reading a long path must not take long.
  const int positions = keys.size() > 1000 ? 8 : 64;
  for (std::size_t i = 1; i < keys.size(); ++i) {
    if (show.camera.fall && falls_at(*show.camera.fall, keys[i].time_s)) {
      continue;
    }
    const CameraKey& from = key_before(show, i);
    for (int k = 1; k < positions && std::min(from.r, keys[i].r) <= safe_r; ++k) {
      check_position(table_of(i), show, from.time_s + (keys[i].time_s - from.time_s) * k / positions);
    }
  }
  if (const Animation* const spin = find_animation(show, "hole.spin")) {
    for (const NumberKey& key : spin->keys) {
      check_position(table_of(key.time_s > keys.back().time_s ? keys.size() - 1 : 0), show, key.time_s);
    }
  }
}

}  // namespace

KeyTable<CameraSettings> camera_keys() {
  static const auto all = keys_of<CameraSettings>(
      other<CameraSettings>("observer",
                            "Velocity of the observer at the camera position. It sets aberration and frequency shift.")
          .by(read_later,
              [](toml::table& table, const CameraSettings& camera) {
                write_motion(table, "observer", {camera.motion, camera.velocity});
              })
          .fixed("the kind of observer is the same for the whole show")
          .page({.type = "word or table", .otherwise = "`\"zamo\"`", .bounds = "see [observers](#observers)"}),
      table<&CameraSettings::keys>("key", keys_of_key, "Positions of the camera: `[[camera.key]]`.")
          .by(read_later, write_camera_keys)
          .page({.otherwise = "required", .bounds = "1 to 100,000 entries", .varies = "its own keys"}),
      table<&CameraSettings::fall>("fall", fall_keys, "Free fall: [`[camera.fall]`](#camerafall)."));
  return all;
}

void read_camera(const toml::table* table, const std::string& file, Show& show) {
  const toml::table empty;
  TomlTable camera(table != nullptr ? *table : empty, file, "camera");
  const WrittenMotion observer = read_motion(camera, "observer", file, {});
  show.camera.motion = observer.motion;
  show.camera.velocity = observer.velocity;
  const auto keys = camera.tables("key", max_keys);
  if (keys.empty()) {
    throw camera.error_at("key", "is missing", "add at least one [[camera.key]] with r, theta_deg and phi_deg");
  }
  for (std::size_t i = 0; i < keys.size(); ++i) {
    TomlTable each(*keys[i], file, fmt::format("camera.key[{}]", i));
    CameraKey key;
    read_settings<CameraKey>(keys_of_key, each, key);
    const bool falls = show.camera.fall && falls_at(*show.camera.fall, key.time_s);
    if (falls && i > 0) {
      take_position_of_fall(each, show.camera.keys.back(), key);
    } else if (!each.has("r")) {
      throw each.error_at("r", "is missing", "give the camera's radius in units of M, for example r = 20");
    }
    check_time(each, show.camera, key);
    if (!falls) {
      take_velocity(each, file, show, key);
      check_key(each, spacetime_at(show, key.time_s), show.camera, key);
    }
    each.refuse_unknown_keys();
    show.camera.keys.push_back(key);
  }
  if (const toml::table* const fall = camera.table("fall")) {
    let_fall(*fall, file, show);
    check_end_of_fall(TomlTable(*fall, file, "camera.fall"), show);
  }
  check_ways(keys, file, show);
  camera.refuse_unknown_keys();
}

void check_spin_on_path(const std::string& file, const Show& show) {
  const Animation* const spin = find_animation(show, "hole.spin");
  if (spin == nullptr) {
    return;
  }
  std::vector<double> times;
  times.reserve(spin->keys.size() + show.camera.keys.size());
  for (const NumberKey& key : spin->keys) {
    times.push_back(key.time_s);
  }
  for (const CameraKey& key : show.camera.keys) {
    times.push_back(key.time_s);
  }
  std::ranges::sort(times);
  constexpr int between = 8;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double span_s = i + 1 < times.size() ? times[i + 1] - times[i] : 0.0;
    for (int k = 0; k < (span_s > 0.0 ? between : 1); ++k) {
      const double time_s = times[i] + span_s * k / between;
      const double horizon = horizon_radius(Spacetime{value_at(*spin, time_s)});
      const double r = camera_pose(show, time_s).r;
      if (!(r > horizon)) {
        const int line = show.lines.at("animate.hole.spin");
        throw Error(
            line == key_set_outside ? show_setting_option : fmt::format("{}:{}", file, line),
            fmt::format("at {:.6g} s this spin has its horizon at {:.6g} M, so that the camera at {:.6g} M is inside",
                        time_s, horizon, r),
            "keep the camera farther out, or choose a larger spin");
      }
    }
  }
}

}  // namespace ergodome
