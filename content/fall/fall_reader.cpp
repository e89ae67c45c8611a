#include "content/fall/fall_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "content/camera/camera_path.h"
#include "content/camera/motion_reader.h"
#include "content/fall/within.h"
#include "content/show/animated_show.h"
#include "content/show/own_number.h"
#include "content/show/show_reader.h"
#include "content/timeline/timeline_reader.h"
#include "kernels/spacetime/kerr/kerr.h"

namespace ergodome {

namespace {

void check_clock(const TomlTable& table, const Show& show) {
  const Animation* const changing = find_animation(show, "camera.fall.clock");
  if (changing == nullptr && !table.has("clock")) {
    throw table.error_at("clock", "is missing", "write clock = 6, or how many M of the camera's own time a second has");
  }
  if (!((changing != nullptr ? range_of(*changing).greatest : show.camera.fall->clock) > 0.0)) {
    throw table.error_at("clock", "never runs", "choose a number above 0");
  }
}

//! The end must leave the clock the time to start and to stop, and be one that the show comes to.
void check_end(const TomlTable& table, const Show& show) {
  const FallSettings& fall = *show.camera.fall;
  if (!fall.until_s) {
    return;
  }
  const double earliest_s = fall.time_s + std::max(2.0 * fall.ease_s, least_key_gap_s);
  constexpr double rounding_s = 1e-9;
  if (!(*fall.until_s >= earliest_s - rounding_s)) {
    throw table.error_at("until_s",
                         fmt::format("is {} s: from {} s on, the clock takes ease_s to start and as long to stop",
                                     *fall.until_s, fall.time_s),
                         fmt::format("let the fall last until {:.6g} s or longer, or make ease_s smaller", earliest_s));
  }
  if (!(*fall.until_s <= show.duration_s)) {
    throw table.error_at("until_s", fmt::format("is {} s, and the show ends at {} s", *fall.until_s, show.duration_s),
                         "leave it out: the camera falls to the end of the show");
  }
}

//! Where time comes to rest: before the horizon, or behind it and before the inner one.
void check_rest(const TomlTable& table, const Show& show, double begin_r) {
  const FallSettings& fall = *show.camera.fall;
  const double horizon = horizon_radius(show.spin);
  const double before = std::ceil(1e5 * nearest_rest * horizon) * 1e-5;
  const double deepest = deepest_rest(show.spin);
  const bool within = fall.least_r > 0.0 && fall.least_r < horizon;
  if (fall.least_r > 0.0 && !(fall.least_r >= before && fall.least_r < begin_r) &&
      !(within && fall.least_r >= deepest && fall.least_r <= horizon / nearest_rest)) {
    throw table.error_at(
        "least_r", fmt::format("is {} M, not between the horizon and the place of the beginning", fall.least_r),
        fmt::format("choose it from {:.6g} to below {:.6g}", before, begin_r) +
            (has_inside(show.spin) ? fmt::format(", or within the horizon, from {:.6g} to {:.6g}", deepest,
                                                 std::floor(1e5 * horizon / nearest_rest) * 1e-5)
                                   : ""));
  }
  if (within && fall.until_s) {
    throw table.error_at("until_s", "ends a fall that least_r leads into the hole",
                         "leave one of both out: from within the horizon keys lead nowhere");
  }
}

//! What can be wrong before the orbit is known.
void check_beginning(const TomlTable& table, const Show& show) {
  const FallSettings& fall = *show.camera.fall;
  const auto key = std::ranges::find(show.camera.keys, fall.time_s, &CameraKey::time_s);
  if (key == show.camera.keys.end()) {
    throw table.error_at("t_s", fmt::format("is {} s, when the camera has no key", fall.time_s),
                         "write a [[camera.key]] with that t_s and the place where the fall begins");
  }
  if (!(fall.time_s < show.duration_s)) {
    throw table.error_at("t_s", fmt::format("is {} s, and the show ends at {} s", fall.time_s, show.duration_s),
                         "let it fall earlier, or give the show a longer duration_s");
  }
  if (find_animation(show, "hole.spin") != nullptr) {
    throw table.error_at("t_s", "begins a fall about a hole whose spin changes",
                         "do not animate hole.spin: orbits are those of a hole that stays as it is");
  }
  check_rest(table, show, key->r);
  const Vector3<double> v = observer_velocity(fall.motion, show.spin, key->r, key->theta, fall.velocity);
  if (!(dot(v, v) <= fastest_observer * fastest_observer * (1.0 + 1e-12))) {
    throw table.error_at(table.has("velocity") ? "velocity" : "t_s",
                         fmt::format("begins a fall at r = {} M with a velocity that would outrun light", key->r),
                         "begin further out, or write velocity = { beta = 0.3, toward = [0, 0, 1] }");
  }
}

}  // namespace

void read_fall(const toml::table* camera, const std::string& file, Show& show) {
  const toml::node* const at = camera != nullptr ? camera->get("fall") : nullptr;
  const toml::table* const from = at != nullptr ? at->as_table() : nullptr;
  if (from == nullptr) {
    return;
  }
  TomlTable table(*from, file, "camera.fall");
  FallSettings& fall = show.camera.fall.emplace();
  fall.time_s = table.number("t_s", 0.0, -1e12, 1e12);
  fall.clock = own_number(table, "clock", 0.0);
  fall.ease_s = table.number("ease_s", fall.ease_s, 0.0, 60.0);
  if (table.has("until_s")) {
    fall.until_s = table.number("until_s", 0.0, -1e12, 1e12);
  }
  fall.least_r = table.number("least_r", 0.0, 0.0, 1e9);
  table.node("velocity");
  check_end(table, show);
  table.refuse_unknown_keys();
}

void take_place_of_fall(const TomlTable& table, const CameraKey& before, CameraKey& key) {
  for (const char* const place : {"r", "theta_deg", "phi_deg"}) {
    if (table.has(place)) {
      throw table.error_at(
          place, "leads a camera that falls",
          "leave r, theta_deg and phi_deg to keys up to camera.fall.t_s and after camera.fall.until_s");
    }
  }
  key.r = before.r;
  key.theta = before.theta;
  key.phi = before.phi;
}

void check_sights_within(TomlTable& root, const std::string& file, const Show& show) {
  const std::optional<LocalText> hidden = leads_within(show) ? hidden_within(show) : std::nullopt;
  if (hidden) {
    const TomlTable fall(*root.table("camera")->get("fall")->as_table(), file, "camera.fall");
    throw fall.error_at(
        "least_r", fmt::format("leads through the horizon, from within which {} cannot be shown", hidden->at("en")),
        "take that out of the show, or choose a least_r outside");
  }
}

void let_fall(const toml::table& fall, const std::string& file, Show& show) {
  TomlTable table(fall, file, "camera.fall");
  FallSettings& settings = *show.camera.fall;
  const WrittenMotion begun = read_motion(table, "velocity", file, {show.camera.motion, show.camera.velocity});
  settings.motion = begun.motion;
  settings.velocity = begun.velocity;
  check_clock(table, show);
  check_beginning(table, show);
  show.camera.orbit = follow_fall(show);
  show.camera.after_fall = keys_after_fall(show);
  const FreeFall& orbit = *show.camera.orbit;
  if (!orbit.leads_within() && orbit.horizon_s() && *orbit.horizon_s() < show.duration_s) {
    const double horizon = horizon_radius(show.spin);
    throw table.error_at(
        "t_s", fmt::format("begins a fall that leads into the horizon at {:.6g} s", *orbit.horizon_s()),
        fmt::format("end the fall before (until_s), or write least_r = {:.4g}, where time comes to rest",
                    1.05 * horizon) +
            (has_inside(show.spin)
                 ? fmt::format("; {:.4g} leads through the horizon", 0.5 * (horizon + deepest_rest(show.spin)))
                 : ""));
  }
  if (!orbit.stop_s() && !orbit.horizon_s() && orbit.followed_s() < show.duration_s) {
    throw table.error_at(
        "clock", fmt::format("runs so fast that the orbit cannot be followed beyond {:.6g} s", orbit.followed_s()),
        "choose a slower clock, a shorter show, or a least_r");
  }
}

}  // namespace ergodome
