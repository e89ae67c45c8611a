#pragma once

#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <vector>

#include "content/camera/fall_clock.h"
#include "kernels/spacetime/geodesic/timelike_orbit.h"

namespace ergodome {

//! Initial position and velocity of a fall.
struct FallStart {
  double r;                  //!< Boyer-Lindquist radius [M]
  double theta;              //!< polar angle [rad]
  double phi;                //!< azimuth [rad]
  Vector3<double> velocity;  //!< velocity in the ZAMO frame (e_r, e_θ, e_φ), below that of light
};

//! A falling camera at one instant.
struct FallPosition {
  double r;      //!< Boyer-Lindquist radius [M]
  double theta;  //!< polar angle [rad]
  //! Azimuth [rad]; continues over many turns; inside the horizon, in ingoing Kerr coordinates.
  double phi;
  //! Velocity in the ZAMO frame; in the rain frame if the fall leads through the horizon.
  Vector3<double> velocity;
  //! Rotation from the initial (e_r, e_θ, e_φ), transported along the fall without a roll around
  //! e_r, to those at this position. It is continuous across the spin axis. If the fall leads
  //! through the horizon, it turns axes boosted from the ZAMO at the start into axes boosted from
  //! the rain at this position.
  glm::dquat frame;
};

//! A turning point of an orbit: minimum or maximum of its radius or of its latitude.
struct FallTurn {
  enum class Kind { nearest, farthest, northernmost, southernmost };
  Kind kind;
  double time_s;
  double r;      //!< Boyer-Lindquist radius [M]
  double theta;  //!< polar angle [rad]
};

//! A timelike geodesic of Kerr spacetime as a function of the camera's proper time, integrated
//! once. The result for an instant does not depend on earlier requests.
//!
//! Stores the state after each integration step; other instants are computed by one shorter step
//! from the preceding state. Step errors are below 1e-13 rad.
class FreeFall {
 public:
  //! Computes the orbit up to the show time `end_s`. It ends earlier at FallSettings::least_r, near
  //! the horizon unless least_r is inside it, or after too many steps.
  FreeFall(Spacetime spacetime, const FallStart& start, const FallSettings& settings, const Animation* clock,
           double end_s);

  [[nodiscard]] double begin_s() const { return settings_.time_s; }
  [[nodiscard]] std::optional<double> until_s() const { return settings_.until_s; }
  [[nodiscard]] double ease_s() const { return settings_.ease_s; }
  [[nodiscard]] const FallStart& start() const { return start_; }

  //! Returns the camera at a show time: before the fall at its start, after the fall at its end.
  [[nodiscard]] FallPosition at(double time_s) const;

  //! Returns the turning points of the orbit in order of time.
  [[nodiscard]] const std::vector<FallTurn>& turns() const { return turns_; }

  //! Returns the minimum radius of the orbit [M].
  [[nodiscard]] double least_r() const { return min_r_; }

  //! Returns true if the fall's settings allow it to cross the horizon and it does.
  [[nodiscard]] bool leads_within() const { return leads_within_; }

  //! Returns the show time when the orbit reaches the horizon [s], or 1e-6 M above it if the fall
  //! may not cross it. Returns nothing if the orbit does not reach it, or stops at
  //! FallSettings::least_r before.
  [[nodiscard]] std::optional<double> horizon_s() const { return horizon_s_; }

  //! Returns the show time when the camera's clock stops at FallSettings::least_r [s]; nothing if
  //! the orbit does not reach that radius.
  [[nodiscard]] std::optional<double> stop_s() const { return stop_s_; }

  //! Returns the show time up to which the orbit was computed [s].
  [[nodiscard]] double followed_s() const { return followed_s_; }

  //! Returns the camera's proper time since the fall began [M].
  [[nodiscard]] double proper_time(double time_s) const;

  //! Returns the angle that the direction from the hole to the camera has swept since the fall
  //! began [rad], across the spin axis or around it.
  [[nodiscard]] double swept_angle(double time_s) const;

 private:
  struct Station {
    double proper_time;  //!< [M]
    OrbitState state;
    double phi;        //!< continuous azimuth [rad]
    double swept;      //!< angle that the direction from the hole has swept since the beginning [rad]
    glm::dquat frame;  //!< FallPosition::frame, but into fixed axes (z along the spin axis)
  };

  struct Swing;

  void begin();
  void follow(double proper_time);
  [[nodiscard]] Station station_after(const Station& from, double proper_time) const;
  [[nodiscard]] Station station_at(double proper_time) const;
  [[nodiscard]] double time_at_radius(const Station& from, double to, double r) const;
  void end_at_radius(const Station& from, double to, double r);
  void note_turn(const Station& from, const Station& to, Swing& swing);
  void note_turns();

  Spacetime spacetime_;
  FallStart start_;
  FallSettings settings_;
  bool leads_within_;
  FallClock clock_;
  OrbitConstants constants_{};
  std::vector<Station> stations_;
  std::vector<FallTurn> turns_;
  double min_r_;
  std::optional<double> crossing_;  //!< proper time of crossing the horizon [M]
  std::optional<double> horizon_s_;
  std::optional<double> stop_s_;
  double followed_s_;
};

}  // namespace ergodome
