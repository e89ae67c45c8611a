#include "app/player/recording/recorded_fall.h"

#include <algorithm>
#include <cmath>

#include "app/navigation/orbit_ride.h"
#include "content/camera/rain_pose.h"
#include "content/camera/within.h"
#include "kernels/spacetime/geodesic/rain_orbit.h"

namespace ergodome {

namespace {

constexpr double proper_time_tolerance = 1e-8;  // [M]

RainOrbit orbit_of(Spacetime spacetime, const CameraPose& falls) {
  const CameraPose ingoing = pose_of(ingoing_placement(falls, spacetime));
  return make_rain_orbit(spacetime, ingoing.r, ingoing.theta, ingoing.phi, *falls.velocity);
}

//! Returns position and velocity of an infalling body, without an orientation.
CameraPose pose_on_orbit(Spacetime spacetime, const OrbitConstants& constants, const OrbitState& s) {
  const double c = std::cos(s.drag);
  const double d = std::sin(s.drag);
  const CameraPlacement placement = {1.0 / s.u,
                                     glm::normalize(glm::dvec3(c * s.m.x - d * s.m.y, d * s.m.x + c * s.m.y, s.m.z))};
  CameraPose pose = pose_of_ingoing(placement, spacetime);
  pose.velocity = orbit_rain_velocity(spacetime, constants, s, pose_of(placement).phi - s.drag);
  pose.velocity_in_rain = true;
  return pose;
}

//! Returns whether a show's fall may begin there: outside the horizon, and slow enough against the
//! ZAMO to avoid rounding errors.
bool may_begin_at(Spacetime spacetime, const CameraPose& falls) {
  constexpr double fastest = 0.99;
  if (!(falls.r > horizon_radius(spacetime))) {
    return false;
  }
  const Vector3<double> velocity = *in_zamo_frame(falls, spacetime).velocity;
  return dot(velocity, velocity) < fastest * fastest;
}

struct FallBeginning {
  CameraPose pose;     //!< pose with a velocity in the rain frame
  double proper_time;  //!< proper time relative to the first moment, at most 0 [M]
};

//! Integrates the orbit backward to where a fall may begin. Returns nothing if there is no such
//! point.
std::optional<FallBeginning> beginning_of(Spacetime spacetime, const CameraPose& first) {
  if (may_begin_at(spacetime, first)) {
    return FallBeginning{first, 0.0};
  }
  constexpr double tolerance = 1e-13;
  constexpr double longest_step = 0.02;  // maximum step of proper time over the radius r
  constexpr int max_steps = 2000;
  const RainOrbit orbit = orbit_of(spacetime, first);
  OrbitState state = orbit.state;
  FallBeginning back = {first, 0.0};
  double h = 1e-3 / state.u;
  for (int step = 0; step < max_steps; ++step) {
    const OrbitStep next = orbit_step(spacetime, orbit.constants, -h, state);
    if (next.error <= tolerance) {
      state = next.end;
      back = {pose_on_orbit(spacetime, orbit.constants, state), back.proper_time - h};
      if (may_begin_at(spacetime, back.pose)) {
        return back;
      }
    }
    h = std::min(h * orbit_step_growth(next.error, tolerance), longest_step / state.u);
  }
  return std::nullopt;
}

struct ProperTimeAt {
  double time_s;
  double proper_time;
};

//! Returns keys of a clock rate [M/s] that is constant between them, as few as keep the proper
//! times within the tolerance. The rate is 0 after the last time.
std::vector<NumberKey> clock_through(const std::vector<ProperTimeAt>& times) {
  std::vector<NumberKey> keys;
  std::size_t from = 0;
  while (from + 1 < times.size()) {
    double minimum = 0.0;
    double maximum = INFINITY;
    double rate = 0.0;
    std::size_t to = from;
    for (std::size_t i = from + 1; i < times.size(); ++i) {
      const double seconds = times[i].time_s - times[from].time_s;
      const double run = times[i].proper_time - times[from].proper_time;
      if (i > from + 1 && !(run / seconds >= minimum && run / seconds <= maximum)) {
        break;
      }
      rate = run / seconds;
      to = i;
      minimum = std::max(minimum, (run - proper_time_tolerance) / seconds);
      maximum = std::min(maximum, (run + proper_time_tolerance) / seconds);
    }
    keys.push_back({times[from].time_s, std::max(rate, 0.0), Ease::hold});
    from = to;
  }
  // Proper time stops after the recording, as a show's camera stops after its last key.
  keys.push_back({times.back().time_s, 0.0, Ease::hold});
  return keys;
}

}  // namespace

bool falls_on(Spacetime spacetime, const FallMoment& before, const FallMoment& after) {
  constexpr double same = 1e-6;
  const OrbitConstants a = orbit_of(spacetime, before.pose).constants;
  const OrbitConstants b = orbit_of(spacetime, after.pose).constants;
  const auto near = [](double x, double y) { return std::abs(x - y) <= same * (1.0 + std::abs(x)); };
  return after.proper_time >= before.proper_time && near(a.energy, b.energy) &&
         near(a.axial_angular_momentum, b.axial_angular_momentum) && near(a.polar_constant, b.polar_constant);
}

std::optional<RecordedFall> recorded_fall(Spacetime spacetime, std::span<const FallMoment> moments, double before_s) {
  const FallMoment& first = moments.front();
  const std::optional<FallBeginning> begins = beginning_of(spacetime, first.pose);
  if (!begins) {
    return std::nullopt;
  }
  const bool earlier = begins->proper_time < 0.0;
  const CameraPose start = in_zamo_frame(begins->pose, spacetime);
  RecordedFall fall;
  fall.start.time_s = earlier ? 0.5 * (before_s + first.time_s) : first.time_s;
  fall.start.r = start.r;
  fall.start.theta = start.theta;
  fall.start.phi = start.phi;
  fall.start.velocity = start.velocity;
  std::vector<ProperTimeAt> times;
  if (earlier) {
    times.push_back({fall.start.time_s, begins->proper_time});
  }
  for (const FallMoment& moment : moments) {
    times.push_back({moment.time_s, moment.proper_time - first.proper_time});
  }
  fall.clock = clock_through(times);
  fall.settings.time_s = fall.start.time_s;
  fall.settings.motion = ObserverMotion::velocity;
  fall.settings.velocity = *start.velocity;
  fall.settings.clock = std::ranges::max(fall.clock, {}, &NumberKey::value).value;
  fall.settings.ease_s = 0.0;
  fall.settings.least_r = deepest_rest(spacetime);
  return fall;
}

void put_fall(const RecordedFall& fall, Show& show) {
  show.camera.fall = fall.settings;
  show.timeline.animations.push_back({"camera.fall.clock", fall.clock});
  show.camera.orbit = follow_fall(show);
  show.camera.after_fall.clear();
}

}  // namespace ergodome
