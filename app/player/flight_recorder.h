#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "content/camera_path.h"
#include "content/show.h"

namespace ergodome {

//! How far a recorded path may be from the flight.
struct RecordTolerance {
  double turn_rad = 1e-3;  //!< of the view, and of the place seen from the hole
  double radius = 1e-3;    //!< part of the radius
  //! Of who looks, as a proper velocity: what is seen is shifted by less than twice that angle [rad].
  double velocity = 5e-4;
};

//! Writes down a flight, so that it becomes the camera path of a show.
class FlightRecorder {
 public:
  //! Notes where the camera is at a time that grows, and how who looks moves; `as_observer`: that is as the scene's observer does. A time that does
  //! not grow, or a place or velocity that is none, is passed over. Thirty a second are kept at most, for an hour; then it is full.
  void note(double time_s, const CameraPose& pose, bool as_observer = false);

  [[nodiscard]] bool empty() const { return samples_.size() < 2; }
  [[nodiscard]] bool full() const;

  //! The flight as few camera keys: camera_pose() of them is within the tolerance of every note. The first is at 0 s. They have
  //! velocities unless all notes are as the scene's observer.
  [[nodiscard]] std::vector<CameraKey> keys(const Show& scene, const RecordTolerance& tolerance = {}) const;

 private:
  struct Sample {
    double time_s;
    CameraPose pose;
    bool as_observer;
  };
  [[nodiscard]] CameraKey key_of(const Sample& sample) const;
  //! The notes, without velocities where the scene's observer has them all.
  [[nodiscard]] std::vector<Sample> needed() const;

  std::vector<Sample> samples_;
};

//! A show of a scene that follows recorded keys; its files are named so that it may stand in another folder.
Show recorded_show(const Show& scene, std::vector<CameraKey> keys, const std::string& title);

//! A key whose orientation is the given one: yaw, pitch and roll from looking at the hole.
CameraKey key_at(double time_s, const CameraPose& pose);

}  // namespace ergodome
