#include "content/show/reading/fall_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "content/camera/camera_path.h"
#include "content/camera/within.h"
#include "content/show/animated_show.h"
#include "content/show/key_table.h"
#include "content/show/reading/motion_reader.h"
#include "content/show/reading/show_reader.h"
#include "content/show/show_schema.h"
#include "kernels/spacetime/kerr/kerr.h"

namespace ergodome {

namespace {

void check_clock(const TomlTable& table, const Show& show) {
  const Animation* const changing = find_animation(show, "camera.fall.clock");
  if (changing == nullptr && !table.has("clock")) {
    throw table.error_at(
        "clock", "is missing",
        "write the camera's own time that passes in a second of the show, for example clock = 6 (in M)");
  }
  if (!((changing != nullptr ? range_of(*changing).maximum : show.camera.fall->clock) > 0.0)) {
    throw table.error_at("clock", "is never above 0, so that the camera would not fall", "choose a number above 0");
  }
}

//! Throws Error if a fall ends too early for its clock to start and stop, or after the show.
void check_end(const TomlTable& table, const Show& show) {
  const FallSettings& fall = *show.camera.fall;
  if (!fall.until_s) {
    return;
  }
  const double earliest_s = fall.time_s + std::max(2.0 * fall.ease_s, min_key_gap_s);
  constexpr double rounding_s = 1e-9;
  if (!(*fall.until_s >= earliest_s - rounding_s)) {
    throw table.error_at("until_s",
                         fmt::format("is {} s, too soon after {} s: the clock needs ease_s to start and ease_s to stop",
                                     *fall.until_s, fall.time_s),
                         fmt::format("choose {:.6g} s or later, or a smaller ease_s", earliest_s));
  }
  if (!(*fall.until_s <= show.duration_s)) {
    throw table.error_at("until_s", fmt::format("is {} s, but the show ends at {} s", *fall.until_s, show.duration_s),
                         "remove it to let the camera fall until the end of the show");
  }
}

//! Throws Error unless least_r is 0, or between the outer horizon and the beginning of the fall, or
//! between the two horizons; the latter only for a fall without an end.
void check_rest(const TomlTable& table, const Show& show, double begin_r) {
  const FallSettings& fall = *show.camera.fall;
  const double horizon = horizon_radius(spacetime_of(show));
  const double before = std::ceil(1e5 * nearest_rest * horizon) * 1e-5;
  const double deepest = deepest_rest(spacetime_of(show));
  const bool within = fall.least_r > 0.0 && fall.least_r < horizon;
  if (fall.least_r > 0.0 && !(fall.least_r >= before && fall.least_r < begin_r) &&
      !(within && fall.least_r >= deepest && fall.least_r <= horizon / nearest_rest)) {
    throw table.error_at(
        "least_r", fmt::format("is {} M, but must lie between the horizon and the start of the fall", fall.least_r),
        fmt::format("choose at least {:.6g} and less than {:.6g}", before, begin_r) +
            (has_inside(spacetime_of(show)) ? fmt::format(", or inside the horizon {:.6g} to {:.6g}", deepest,
                                                          std::floor(1e5 * horizon / nearest_rest) * 1e-5)
                                            : ""));
  }
  if (within && fall.until_s) {
    throw table.error_at("until_s",
                         "cannot end the fall, because least_r is inside the horizon, which the camera cannot leave",
                         "remove until_s or least_r");
  }
}

//! Throws Error unless the fall begins at a camera key, before the show's end and slower than
//! light, its least_r is allowed (check_rest()), and the spin is not animated.
void check_beginning(const TomlTable& table, const Show& show) {
  const FallSettings& fall = *show.camera.fall;
  const auto key = std::ranges::find(show.camera.keys, fall.time_s, &CameraKey::time_s);
  if (key == show.camera.keys.end()) {
    throw table.error_at("t_s", fmt::format("is {} s, but the camera has no key at that time", fall.time_s),
                         "add a [[camera.key]] with that t_s and the position where the fall begins");
  }
  if (!(fall.time_s < show.duration_s)) {
    throw table.error_at("t_s", fmt::format("is {} s, but the show ends at {} s", fall.time_s, show.duration_s),
                         "start the fall earlier, or increase duration_s");
  }
  if (find_animation(show, "hole.spin") != nullptr) {
    throw table.error_at("t_s", "starts a fall while the spin of the hole is animated",
                         "do not animate hole.spin: a free fall needs a constant spin");
  }
  check_rest(table, show, key->r);
  const Vector3<double> v = observer_velocity(fall.motion, spacetime_of(show), key->r, key->theta, fall.velocity);
  if (!(dot(v, v) <= fastest_observer * fastest_observer * (1.0 + 1e-12))) {
    throw table.error_at(table.has("velocity") ? "velocity" : "t_s",
                         fmt::format("starts a fall at r = {} M with a velocity faster than light", key->r),
                         "start farther out, or write velocity = { beta = 0.3, toward = [0, 0, 1] }");
  }
}

constexpr auto keys_of_fall = keys_of<FallSettings>(
    key<&FallSettings::time_s>(
        "t_s", "Start of the fall. A camera key must have the same `t_s`, and it must be before the end of the show.")
        .range(-1e12, 1e12, "s"),
    // let_fall() reads it, because its default is the velocity of the camera's observer.
    other<FallSettings>("velocity", "Velocity at the start.")
        .by([](TomlTable& table, FallSettings& /*fall*/) { table.node("velocity"); },
            [](toml::table& table, const FallSettings& fall) {
              write_motion(table, "velocity", {fall.motion, fall.velocity});
            })
        .page({.type = "word or table",
               .otherwise = "that of `camera.observer`",
               .bounds = "see [observers](#observers)"}),
    key<&FallSettings::clock>(
        "clock", "The camera's own time that passes in one second of the show. It must be above 0 at some time.")
        .range(0.0, 1e9, "M/s")
        .animated()
        .page({.otherwise = "required, unless animated"}),
    key<&FallSettings::ease_s>("ease_s",
                               "Time in which the velocity changes before the fall, and in which the clock starts.")
        .range(0.0, 60.0, "s"),
    key<&FallSettings::least_r>(
        "least_r", "Radius at which the clock stops. A value below the horizon leads the fall through the horizon.")
        .range(0.0, 1e9, "M")
        .written_if([](const FallSettings& fall) { return fall.least_r > 0.0; })
        .unused_if([](const Show& show, const FallSettings& fall) {
          return show.camera.orbit && show.camera.orbit->least_r() > (1.0 + 1e-9) * fall.least_r
                     ? "has no effect: the fall never comes this close to the hole"
                     : nullptr;
        })
        .page({.otherwise = "absent", .bounds = "see [into the hole](#into-the-hole)"}),
    key<&FallSettings::until_s>("until_s", "End of the fall. If absent, the camera falls until the end of the show.")
        .range(-1e12, 1e12, "s")
        .page({.bounds = "`t_s` + 2 `ease_s` to `duration_s`"}));

}  // namespace

constinit const KeyTable<FallSettings> fall_keys = keys_of_fall;

void read_fall(const toml::table* camera, const std::string& file, Show& show) {
  const toml::node* const at = camera != nullptr ? camera->get("fall") : nullptr;
  const toml::table* const from = at != nullptr ? at->as_table() : nullptr;
  if (from == nullptr) {
    return;
  }
  TomlTable table(*from, file, "camera.fall");
  FallSettings& fall = show.camera.fall.emplace();
  read_settings(fall_keys, table, fall);
  check_end(table, show);
  table.refuse_unknown_keys();
}

void take_position_of_fall(const TomlTable& table, const CameraKey& before, CameraKey& key) {
  for (const char* const position : {"r", "theta_deg", "phi_deg"}) {
    if (table.has(position)) {
      throw table.error_at(
          position, "is given while the camera falls",
          "write r, theta_deg and phi_deg only in keys up to camera.fall.t_s and after camera.fall.until_s");
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
    throw fall.error_at("least_r",
                        fmt::format("leads through the horizon, but {} cannot be shown inside it", hidden->at("en")),
                        "change that setting, or choose a least_r outside the horizon");
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
    const double horizon = horizon_radius(spacetime_of(show));
    throw table.error_at(
        "t_s", fmt::format("starts a fall that reaches the horizon at {:.6g} s", *orbit.horizon_s()),
        fmt::format("end the fall earlier with until_s, or write least_r = {:.4g} to stop outside the horizon",
                    1.05 * horizon) +
            (has_inside(spacetime_of(show)) ? fmt::format(", or least_r = {:.4g} to fall through it",
                                                          0.5 * (horizon + deepest_rest(spacetime_of(show))))
                                            : ""));
  }
  if (!orbit.stop_s() && !orbit.horizon_s() && orbit.followed_s() < show.duration_s) {
    throw table.error_at(
        "clock", fmt::format("is so fast that the orbit can be computed only up to {:.6g} s", orbit.followed_s()),
        "choose a smaller clock or a shorter show, or set least_r");
  }
}

}  // namespace ergodome
