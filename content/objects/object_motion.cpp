#include "content/objects/object_motion.h"

#include <cmath>

#include "content/show/animated_show.h"
#include "kernels/core/angles.h"

namespace ergodome {

namespace {

//! Returns the position on an orbit at a show time, advanced by the angle `ahead` [rad].
Vector3<double> position_on(const ObjectOrbit& orbit, double time_s, double ahead) {
  const double turns = orbit_rate(orbit) * std::abs(orbit.speed) * time_s / full_turn;
  // Subtracts whole turns first, which keeps the angle accurate in shows that run for years.
  const double angle = orbit.phi + full_turn * (turns - std::floor(turns)) + ahead;
  const double along = orbit.r * std::cos(angle);
  const double across = orbit.r * std::sin(angle) * std::cos(orbit.inclination);
  return {along * std::cos(orbit.node) - across * std::sin(orbit.node),
          along * std::sin(orbit.node) + across * std::cos(orbit.node),
          orbit.r * std::sin(angle) * std::sin(orbit.inclination)};
}

Vector3<double> position_at(const ObjectSettings& object, double time_s) {
  if (object.orbit) {
    return position_on(*object.orbit, time_s, 0.0);
  }
  if (const auto& keys = object.keys; !keys.empty()) {
    const auto coordinate = [&](double Vector3<double>::*const part) {
      return value_at(
          keys.size(),
          [&](std::size_t i) {
            return NumberKey{keys[i].time_s, keys[i].position.*part, keys[i].ease};
          },
          time_s);
    };
    return {coordinate(&Vector3<double>::x), coordinate(&Vector3<double>::y), coordinate(&Vector3<double>::z)};
  }
  return object.position;
}

}  // namespace

double orbit_rate(const ObjectOrbit& orbit) {
  const double way = std::copysign(1.0, orbit.speed);
  return way / (orbit.r * std::sqrt(orbit.r) + way * std::cos(orbit.inclination) * orbit.spacetime.spin);
}

ObjectPlacement placement_at(const ObjectSettings& object, double time_s) {
  const double sx = std::sin(object.turn.x);
  const double cx = std::cos(object.turn.x);
  const double sy = std::sin(object.turn.y);
  const double cy = std::cos(object.turn.y);
  const double sz = std::sin(object.turn.z);
  const double cz = std::cos(object.turn.z);
  ObjectPlacement placement = {position_at(object, time_s),
                               {{cz * cy, cz * sy * sx - sz * cx, cz * sy * cx + sz * sx},
                                {sz * cy, sz * sy * sx + cz * cx, sz * sy * cx - cz * sx},
                                {-sy, cy * sx, cy * cx}}};
  if (object.orbit && object.orbit->speed != 0.0) {
    placement.ahead = position_on(*object.orbit, time_s, 0.25 * full_turn);
    placement.rate = orbit_rate(*object.orbit);
  }
  return placement;
}

}  // namespace ergodome
