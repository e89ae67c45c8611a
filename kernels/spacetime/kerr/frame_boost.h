#pragma once

#include "kernels/core/arithmetic.h"
#include "kernels/spacetime/kerr/observer.h"

// Aberration as a conformal map of the sky, between the frames of observer, ZAMO and rain.
namespace ergodome {

//! Aberration between two frames, one of which moves along `axis`: a stretch of the sky about it.
//!
//! In stereographic coordinates about the direction of motion, aberration multiplies by the Doppler
//! factor k = γ (1 + β). This form is accurate at any speed, whereas the components of a boosted
//! vector cancel.
template <class S>
struct FrameBoostOf {
  Vector3<S> axis = {S(1), S(0), S(0)};  //!< unit vector along the motion of the source frame
  S stretch = S(1);                      //!< k; 1 leaves directions unchanged
};

using FrameBoost = FrameBoostOf<double>;

//! Aberration from an observer's frame to the rain frame at the same position, through the ZAMO
//! frame.
template <class S>
struct AberrationOf {
  FrameBoostOf<S> zamo_from_observer;
  FrameBoostOf<S> rain_from_zamo;
};

using Aberration = AberrationOf<double>;

inline namespace ERGO_TARGET {

//! Transforms a unit viewing direction to a frame relative to which its source frame moves as in
//! `boost`. `energy` receives the photon's energy in the new frame divided by that in the source
//! frame. Small angles about the direction shrink by the same factor, because aberration is
//! conformal.
template <class T>
ERGO_HD Vector3<T> aberrated(const FrameBoostOf<ScalarOf<T>>& boost, const Vector3<T>& n, T& energy) {
  using S = ScalarOf<T>;
  const S k = boost.stretch;
  const T along = n.x * boost.axis.x + n.y * boost.axis.y + n.z * boost.axis.z;
  const Vector3<T> across = {n.x - along * boost.axis.x, n.y - along * boost.axis.y, n.z - along * boost.axis.z};
  // 1 - cos and 1 + cos of the angle to the boost's axis, each without cancellation.
  const T square = dot(across, across);
  const auto forwards = along > T(S(0));
  const T larger = S(1) + select(forwards, along, -along);
  const T smaller = square / larger;
  const T with = select(forwards, larger, smaller) * (S(1) / k);
  const T against = select(forwards, smaller, larger) * k;
  energy = (with + against) * S(0.5);
  const T inverse = S(1) / energy;
  const T new_along = (with - against) * (S(0.5) * inverse);
  return {across.x * inverse + new_along * boost.axis.x, across.y * inverse + new_along * boost.axis.y,
          across.z * inverse + new_along * boost.axis.z};
}

//! Returns the boost for a frame that moves at velocity β relative to the other, |β| < 1.
ERGO_HD FrameBoost frame_boost(const Vector3<double>& beta) {
  const double speed = ::sqrt(dot(beta, beta));
  if (!(speed > 0.0)) {
    return {};
  }
  return {(1.0 / speed) * beta, ::sqrt((1.0 + speed) / (1.0 - speed))};
}

//! Returns the aberration for an observer at (r, θ). See make_camera_station() for the arguments
//! and for the motions that are valid inside the horizon.
ERGO_HD Aberration aberration_to_rain(Spacetime spacetime, double r, double theta, ObserverMotion motion,
                                      const Vector3<double>& given) {
  if (motion == ObserverMotion::rain) {
    return {};
  }
  if (motion == ObserverMotion::rain_boost) {
    return {{}, frame_boost(given)};
  }
  const KerrFunctions f = kerr_functions(spacetime, r, theta);
  // The rain falls at v = rain_speed past the ZAMO, whose lapse √(ΣΔ/A) is 1/γ.
  const double lapse = ::sqrt(f.sigma * f.delta / f.area);
  return {frame_boost(observer_velocity(motion, spacetime, r, theta, given)),
          {{1.0, 0.0, 0.0}, (1.0 + f.rain_speed) / lapse}};
}

//! Returns the identity, for directions that are already in the observer's frame.
ERGO_HD Aberration no_aberration() { return {{{1.0, 0.0, 0.0}, 1.0}, {{1.0, 0.0, 0.0}, 1.0}}; }

template <class S>
ERGO_HD FrameBoostOf<S> converted_boost(const FrameBoost& b) {
  return {{static_cast<S>(b.axis.x), static_cast<S>(b.axis.y), static_cast<S>(b.axis.z)}, static_cast<S>(b.stretch)};
}

template <class S>
ERGO_HD AberrationOf<S> converted_aberration(const Aberration& a) {
  return {converted_boost<S>(a.zamo_from_observer), converted_boost<S>(a.rain_from_zamo)};
}

//! Transforms a direction from the observer's frame to the rain frame. `energy` receives the
//! photon's energy in the rain frame divided by the energy that the observer measures.
template <class T>
ERGO_HD Vector3<T> rain_direction(const AberrationOf<ScalarOf<T>>& aberration, const Vector3<T>& n, T& energy) {
  T to_zamo;
  T to_rain;
  const Vector3<T> seen =
      aberrated(aberration.rain_from_zamo, aberrated(aberration.zamo_from_observer, n, to_zamo), to_rain);
  energy = to_zamo * to_rain;
  return seen;
}

template <class T>
ERGO_HD Vector3<T> rain_direction(const AberrationOf<ScalarOf<T>>& aberration, const Vector3<T>& n) {
  T energy;
  return rain_direction(aberration, n, energy);
}

//! Transforms a direction from the rain frame back to the observer's frame.
template <class T>
ERGO_HD Vector3<T> observed_direction(const AberrationOf<ScalarOf<T>>& aberration, const Vector3<T>& n) {
  using S = ScalarOf<T>;
  const auto inverse = [](const FrameBoostOf<S>& b) { return FrameBoostOf<S>{b.axis, S(1) / b.stretch}; };
  T energy;
  return aberrated(inverse(aberration.zamo_from_observer), aberrated(inverse(aberration.rain_from_zamo), n, energy),
                   energy);
}

//! Returns the factor by which the observer sees small angles about the rain-frame direction n
//! enlarged.
template <class T>
ERGO_HD T observed_scale(const AberrationOf<ScalarOf<T>>& aberration, const Vector3<T>& n) {
  using S = ScalarOf<T>;
  const auto inverse = [](const FrameBoostOf<S>& b) { return FrameBoostOf<S>{b.axis, S(1) / b.stretch}; };
  T to_zamo;
  T to_observer;
  const Vector3<T> in_zamo = aberrated(inverse(aberration.rain_from_zamo), n, to_zamo);
  aberrated(inverse(aberration.zamo_from_observer), in_zamo, to_observer);
  return S(1) / (to_zamo * to_observer);
}

}  // namespace ERGO_TARGET
}  // namespace ergodome
