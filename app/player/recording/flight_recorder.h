#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/player/recording/recorded_fall.h"
#include "app/player/recording/recorded_keys.h"
#include "content/show/show.h"

namespace ergodome {

//! What is noted of a camera that falls through the horizon, or on its way there.
struct FallingNote {
  double own_time;     //!< of the camera, from any beginning [M]
  bool beyond_return;  //!< is_beyond_return()
};

//! One moment of a flight.
struct FlightSample {
  double time_s;
  CameraPose pose;                     //!< with the velocity of who looks
  double spin;                         //!< of the hole at that moment
  bool as_observer;                    //!< whether who looks moves as the scene's observer does
  std::optional<FallingNote> falling;  //!< where who looks is who falls, whose pose has a velocity in the rain's frame
};

//! A flight as a show has it: camera keys, and the fall through the horizon that they end in.
struct RecordedPath {
  std::vector<CameraKey> keys;
  std::optional<RecordedFall> fall;
};

//! Writes down a flight, so that it becomes the camera path of a show.
class FlightRecorder {
 public:
  //! Notes a moment of a time that grows. A time that does not grow, or a place or velocity that is none, is passed over. Thirty a second are kept
  //! at most, for an hour; then it is full.
  //!
  //! Where a fall has been beyond return, the record ends with it, at the first moment that is not later on the same orbit of the same hole: to
  //! other places no path of a show leads from there.
  void note(FlightSample sample);

  //! Ends the record: nothing is noted any more.
  void end() { ended_ = true; }

  [[nodiscard]] bool empty() const { return samples_.size() < 2; }
  [[nodiscard]] bool full() const;
  //! Whether the last note is of a fall that does not come out again.
  [[nodiscard]] bool beyond_return() const;
  //! Whether a fall through the horizon was left, or somebody ended the record.
  [[nodiscard]] bool ended() const { return ended_; }

  //! The flight as few camera keys: camera_pose() of them is within the tolerance of every note. The first is at 0 s. They have
  //! velocities unless all notes are as the scene's observer.
  //!
  //! Where the camera fell through the horizon, the keys have it as far as where that fall began, and then but where it looked; a fall whose
  //! beginning cannot be found, or that was into a hole of another spin than the scene's, ends the path there.
  [[nodiscard]] RecordedPath path(const Show& scene, const RecordTolerance& tolerance = {}) const;

 private:
  std::vector<FlightSample> samples_;
  bool ended_ = false;
};

//! A show of a scene that follows a recorded path; its files are named so that it may stand in another folder.
Show recorded_show(const Show& scene, RecordedPath path, const std::string& title);

}  // namespace ergodome
