#pragma once

#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <vector>

#include "content/fall/fall_clock.h"
#include "kernels/spacetime/geodesic/timelike_orbit.h"

namespace ergodome {

//! Where and how fast a fall begins.
struct FallStart {
  double r;                  //!< [M]
  double theta;              //!< [rad]
  double phi;                //!< [rad]
  Vector3<double> velocity;  //!< in the ZAMO frame (e_r, e_θ, e_φ), slower than light
};

//! A falling camera at one instant.
struct FallPlace {
  double r;                  //!< [M]
  double theta;              //!< [rad]
  double phi;                //!< [rad]; goes on over many turns; within the horizon that of ingoing Kerr coordinates
  Vector3<double> velocity;  //!< in the ZAMO frame; in the rain's of a fall that leads through the horizon
  //! From (e_r, e_θ, e_φ) as they were when the fall began, taken along without a roll about e_r, to those of this place. The axis is no
  //! seam to it. Where the fall leads through the horizon, what is boosted from the ZAMO at its start is boosted from the rain in it.
  glm::dquat frame;
};

//! What an orbit does at one instant: it is farthest in or out, or farthest north or south.
struct FallTurn {
  enum class Kind { nearest, farthest, northernmost, southernmost };
  Kind kind;
  double time_s;
  double r;      //!< [M]
  double theta;  //!< [rad]
};

//! A timelike geodesic of Kerr's spacetime, followed once by a camera's own time; any instant of it comes out the same, whoever asks when.
//!
//! What is kept are the states after each step of the integration; an instant is one shorter step from the state before it. Steps have
//! errors below 1e-13 rad.
class FreeFall {
 public:
  //! Follows the orbit to `end_s`, where its end is not nearer: by the horizon, at `least_r`, or after too many steps.
  FreeFall(double spin, const FallStart& start, const FallSettings& settings, const Animation* clock, double end_s);

  [[nodiscard]] double begin_s() const { return settings_.time_s; }
  [[nodiscard]] std::optional<double> until_s() const { return settings_.until_s; }
  [[nodiscard]] double ease_s() const { return settings_.ease_s; }
  [[nodiscard]] const FallStart& start() const { return start_; }

  //! The camera at a time of the show: at its start before, at its end after.
  [[nodiscard]] FallPlace at(double time_s) const;

  //! Where the orbit turns, in order of time.
  [[nodiscard]] const std::vector<FallTurn>& turns() const { return turns_; }

  //! The nearest that it comes to the hole [M].
  [[nodiscard]] double least_r() const { return least_r_; }

  //! Whether the fall is meant to lead through the horizon, and comes there.
  [[nodiscard]] bool leads_within() const { return leads_within_; }

  //! When the horizon is reached; nothing where it is not.
  [[nodiscard]] std::optional<double> horizon_s() const { return horizon_s_; }

  //! When time comes to rest at FallSettings::least_r; nothing where the orbit does not come there.
  [[nodiscard]] std::optional<double> stop_s() const { return stop_s_; }

  //! How far the orbit has been followed [s].
  [[nodiscard]] double followed_s() const { return followed_s_; }

  //! The camera's own time since the fall began [M].
  [[nodiscard]] double proper_time(double time_s) const;

  //! The angle that the direction from the hole to the camera has swept since then [rad], over the axis or round it.
  [[nodiscard]] double swept_angle(double time_s) const;

 private:
  struct Station {
    double proper_time;  //!< [M]
    OrbitState state;
    double phi;        //!< azimuth without jumps [rad]
    double swept;      //!< angle [rad]
    glm::dquat frame;  //!< FallPlace's, to the directions of space (z along the spin axis)
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

  double spin_;
  FallStart start_;
  FallSettings settings_;
  bool leads_within_;
  FallClock clock_;
  OrbitConstants constants_{};
  std::vector<Station> stations_;
  std::vector<FallTurn> turns_;
  double least_r_;
  std::optional<double> crossing_;  //!< own time at the horizon of a fall that leads through it [M]
  std::optional<double> horizon_s_;
  std::optional<double> stop_s_;
  double followed_s_;
};

}  // namespace ergodome
