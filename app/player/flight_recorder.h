#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/player/recorded_fall.h"
#include "app/player/recorded_keys.h"
#include "content/show.h"

namespace ergodome {

//! What is noted of a camera that falls through the horizon, or on its way there.
struct FallingNote {
  double own_time;     //!< of the camera, from any beginning [M]
  bool beyond_return;  //!< is_beyond_return()
};

//! One moment of a flight.
struct FlightSample {
  double time_s;
  CameraPose pose;
  bool as_observer;
  std::optional<FallingNote> falling;
};

//! A flight as a show has it: camera keys, and the fall through the horizon that they end in.
struct RecordedPath {
  std::vector<CameraKey> keys;
  std::optional<RecordedFall> fall;
};

//! Writes down a flight, so that it becomes the camera path of a show.
class FlightRecorder {
 public:
  //! Notes where the camera is at a time that grows, and how who looks moves; `as_observer`: that is as the scene's observer does. A time that does
  //! not grow, or a place or velocity that is none, is passed over. Thirty a second are kept at most, for an hour; then it is full.
  //!
  //! `falling` is given where who looks is who falls, whose pose has a velocity in the rain's frame. Where such a fall has been beyond return, the
  //! record ends with it: to other places no path of a show leads from there.
  void note(double time_s, const CameraPose& pose, bool as_observer = false, std::optional<FallingNote> falling = {});

  [[nodiscard]] bool empty() const { return samples_.size() < 2; }
  [[nodiscard]] bool full() const;
  //! Whether a fall through the horizon was left: nothing is noted any more.
  [[nodiscard]] bool ended() const { return ended_; }

  //! The flight as few camera keys: camera_pose() of them is within the tolerance of every note. The first is at 0 s. They have
  //! velocities unless all notes are as the scene's observer.
  //!
  //! Where the camera fell through the horizon, the keys have it as far as where that fall began, and then but where it looked; a fall whose
  //! beginning cannot be found ends the path there.
  [[nodiscard]] RecordedPath path(const Show& scene, const RecordTolerance& tolerance = {}) const;

 private:
  std::vector<FlightSample> samples_;
  bool ended_ = false;
};

//! A show of a scene that follows a recorded path; its files are named so that it may stand in another folder.
Show recorded_show(const Show& scene, RecordedPath path, const std::string& title);

}  // namespace ergodome
