#pragma once

#include <glm/gtc/quaternion.hpp>

#include "content/fall/free_fall.h"
#include "content/show/show.h"

namespace ergodome {

//! Where the camera is and how it is turned.
//!
//! `orientation` rotates the view's axes (x right, y up, z back, as in OpenGL) into the local frame (e_r, e_θ, e_φ). Looking at
//! the hole, right is e_φ, up is -e_θ (towards the spin axis) and back is e_r.
struct CameraPose {
  double r;      //!< [M]
  double theta;  //!< [rad]
  double phi;    //!< [rad]; within the horizon the azimuth of ingoing Kerr coordinates
  glm::dquat orientation;
  //! Of who looks, in the ZAMO frame, slower than light; absent: as the show's observer moves, or another one that was asked for in its place.
  std::optional<Vector3<double>> velocity = std::nullopt;
  //! That velocity is one in the rain's frame, and the axes are boosted from it: of a camera that falls through the horizon.
  bool velocity_in_rain = false;
  //! By how much the camera's Boyer-Lindquist time, of which it sees what stands outside, is ahead of the show's [M]: of a camera that falls through the
  //! horizon, where that time has no end, and behind which light is late by the time of who falls in (ingoing_lag()).
  double clock_lead = 0.0;
};

//! The camera at a show time: at the keys exactly as they say, and for as long as they hold it.
//!
//! Between them r (its logarithm), θ and φ follow quintics that do not overshoot, and the orientation a quaternion spline; both are C²,
//! but beside Ease::linear and where the first or last way is told not to ease. Before the first key and after the last one it holds.
//!
//! Where keys have velocities, these follow such quintics, too, as proper velocities (proper_velocity.h).
//!
//! From where a fall begins its orbit gives the place and the velocity, and the keys the orientation, in a frame that goes along
//! (FallPlace::frame). In FallSettings::ease_s before it, the velocity goes over from the observer's to that at which the fall begins.
//! From where the fall ends the keys lead the camera again (keys_after_fall), and the velocity goes back to the observer's as it came.
CameraPose camera_pose(const Show& show, double time_s);

//! Orientation of one key.
glm::dquat key_orientation(const CameraKey& key);

//! Unit vectors e_r, e_θ, e_φ as the columns of a rotation, for polar coordinates [rad].
glm::dquat spherical_frame(double theta, double phi);

//! Follows the fall of a show's camera to a second after the show's end, or to its own end if that is nearer; nullptr where the camera does
//! not fall. There is a key when it begins, and all numbers of the show have been read.
std::shared_ptr<const FreeFall> follow_fall(const Show& show);

//! The places between which a camera goes when its fall has ended, in order: the fall's own end, as a key, and the keys after it. Azimuths go on
//! from the fall's, the shorter way round to the first key. Empty where the camera does not fall, or falls to the end of the show.
std::vector<CameraKey> keys_after_fall(const Show& show);

//! Whether the camera falls through the horizon.
bool leads_within(const Show& show);

//! Whether the camera's place or orientation changes in the course of the show.
bool camera_moves(const Show& show);

//! Times between which r and θ run one way, in order, from the show's beginning to its end: keys, where the orbit of a fall turns, and where the velocity
//! begins to go over to the fall's and has gone back [s].
std::vector<double> path_ends_s(const Show& show);

}  // namespace ergodome
