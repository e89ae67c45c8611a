#include "app/navigation/observer_mode.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace ergodome {

namespace {

constexpr double fade_s = 1.0;

struct Words {
  const char* name;
  //! Words that are added if the observer is a replacement for an impossible one.
  const char* stand_in;
};

constexpr std::array<Words, 6> english = {{
    {"carried along with space", ""},
    {"static observer", "nothing can stand still here: slowest possible motion instead"},
    {"circular orbit", "no circular orbit here: nearest possible speed instead"},
    {"circular orbit, retrograde", "no circular orbit here: nearest possible speed instead"},
    {"falling from rest", ""},
    {"moving observer", ""},
}};

constexpr std::array<Words, 6> german = {{
    {"vom Raum mitgeführt", ""},
    {"ruhender Beobachter", "hier kann nichts stillstehen: stattdessen so langsam wie möglich"},
    {"Kreisbahn", "hier gibt es keine Kreisbahn: stattdessen nächstmögliche Geschwindigkeit"},
    {"Kreisbahn, rückläufig", "hier gibt es keine Kreisbahn: stattdessen nächstmögliche Geschwindigkeit"},
    {"freier Fall aus der Ruhe", ""},
    {"bewegter Beobachter", ""},
}};

const Words& words_of(ObserverMotion motion, std::string_view language) {
  return (language == "de" ? german : english)[static_cast<std::size_t>(motion)];
}

double length(const Vector3<double>& v) { return std::sqrt(dot(v, v)); }

ObserverMotion motion_of(ObserverMode mode) {
  constexpr std::array motions = {ObserverMotion::zamo,     ObserverMotion::zamo,       ObserverMotion::fixed,
                                  ObserverMotion::geodesic, ObserverMotion::retrograde, ObserverMotion::rain};
  return motions[static_cast<std::size_t>(mode)];
}

}  // namespace

ObserverMode next_observer(ObserverMode mode) { return static_cast<ObserverMode>((static_cast<int>(mode) + 1) % 6); }

NearestVelocity nearest_velocity(ObserverMotion motion, Spacetime spacetime, double r, double theta) {
  if (motion == ObserverMotion::zamo || motion == ObserverMotion::rain) {
    return {observer_velocity(motion, spacetime, r, theta, {}), false};
  }
  if (!(std::abs(std::sin(theta)) > 0.0)) {
    return {};  // on the spin axis nothing orbits
  }
  const double along = observer_velocity(motion, spacetime, r, theta, {}).z;
  if (std::isnan(along)) {
    return {{0.0, 0.0, motion == ObserverMotion::geodesic ? fastest_stand_in : -fastest_stand_in}, true};
  }
  const double cut = std::clamp(along, -fastest_stand_in, fastest_stand_in);
  return {{0.0, 0.0, cut}, cut != along};
}

ObserverView observer_of(ObserverMotion motion, const Vector3<double>& given, Spacetime spacetime, double r,
                         double theta, std::string_view language) {
  const Words& words = words_of(motion, language);
  ObserverView view;
  view.name = words.name;
  view.sentence = words.name;
  view.motion = motion;
  if (motion == ObserverMotion::zamo) {
    return view;
  }
  if (motion == ObserverMotion::velocity) {
    view.velocity = given;
  } else {
    const NearestVelocity nearest = nearest_velocity(motion, spacetime, r, theta);
    view.velocity = nearest.velocity;
    view.nearest = nearest.nearest;
    view.motion = motion == ObserverMotion::rain ? motion : ObserverMotion::velocity;
  }
  view.sentence += fmt::format(", {:.2f} c", std::min(length(view.velocity), 0.99));
  if (view.nearest) {
    view.sentence += fmt::format(" ({})", words.stand_in);
  }
  return view;
}

ObserverView falling_observer(const Vector3<double>& velocity, std::string_view language) {
  ObserverView view;
  view.name = language == "de" ? "im freien Fall" : "in free fall";
  view.sentence = fmt::format("{}, {:.2f} c", view.name, std::min(length(velocity), 0.99));
  view.motion = ObserverMotion::velocity;
  view.velocity = velocity;
  return view;
}

ObserverView falling_within(std::string_view language) {
  ObserverView view;
  view.name = language == "de" ? "im freien Fall, innerhalb des Horizonts" : "in free fall, inside the horizon";
  view.sentence = view.name;
  view.motion = ObserverMotion::velocity;
  return view;
}

ObserverView falling_into_hole(double r, Spacetime spacetime, const Vector3<double>& in_zamo,
                               std::optional<double> left, std::string_view language) {
  const bool german = language == "de";
  if (r > horizon_radius(spacetime)) {
    ObserverView view = falling_observer(in_zamo, language);
    view.name = german ? "im Fall ins Loch" : "falling into the hole";
    view.sentence = view.name + view.sentence.substr(view.sentence.rfind(','));
    return view;
  }
  ObserverView view = falling_within(language);
  view.name = german ? "innerhalb des Horizonts" : "inside the horizon";
  view.sentence = fmt::format("{}, r = {:.2f} M", view.name, r);
  if (left) {
    view.sentence +=
        german ? fmt::format(", noch {:.2f} M Eigenzeit", *left) : fmt::format(", {:.2f} M of proper time left", *left);
  }
  return view;
}

ObserverView observer_view(ObserverMode mode, const CameraSettings& shown, const std::optional<ObserverView>& own,
                           Spacetime spacetime, double r, double theta, std::string_view language) {
  if (mode == ObserverMode::natural) {
    return own ? *own : observer_of(shown.motion, shown.velocity, spacetime, r, theta, language);
  }
  return observer_of(motion_of(mode), {}, spacetime, r, theta, language);
}

ObserverView ObserverFade::advance(double seconds, const ObserverView& wanted, Spacetime spacetime,
                                   const CameraPose& pose) {
  const Vector3<double> target = wanted.motion == ObserverMotion::velocity
                                     ? wanted.velocity
                                     : observer_velocity(wanted.motion, spacetime, pose.r, pose.theta, {});
  const glm::dquat frame = spherical_frame(pose.theta, pose.phi);
  if (!name_.empty() && name_ != wanted.name) {
    from_ = shown_;
    elapsed_s_ = 0.0;
  }
  name_ = wanted.name;
  elapsed_s_ += std::clamp(seconds, 0.0, 0.1);
  const glm::dvec3 there = frame * glm::dvec3(target.x, target.y, target.z);
  if (elapsed_s_ >= fade_s) {
    shown_ = there;
    return wanted;
  }
  // Velocities below that of light form a ball, so velocities on the straight line between two of
  // them are also below it.
  const double s = elapsed_s_ / fade_s;
  shown_ = glm::mix(from_, there, s * s * (3.0 - 2.0 * s));
  const glm::dvec3 local = glm::conjugate(frame) * shown_;
  ObserverView view = wanted;
  view.motion = ObserverMotion::velocity;
  view.velocity = {local.x, local.y, local.z};
  return view;
}

bool ObserverFade::fading() const { return elapsed_s_ < fade_s; }

}  // namespace ergodome
