#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/player/recording/recorded_fall.h"
#include "app/player/recording/recorded_keys.h"
#include "content/show/show.h"

namespace ergodome {

//! State of a camera that falls through the horizon, or is on its way there.
struct FallingNote {
  double proper_time;  //!< proper time of the camera, from any origin [M]
  bool beyond_return;  //!< is_beyond_return()
};

//! One moment of a flight.
struct FlightSample {
  double time_s;
  CameraPose pose;      //!< pose with the observer's velocity
  Spacetime spacetime;  //!< spacetime at the time of the sample
  bool as_observer;     //!< whether the observer moves as the scene's observer does
  //! Present if the observer is infalling; the pose then has a velocity in the rain frame.
  std::optional<FallingNote> falling;
};

//! A flight in the form of a show: camera keys, and the fall through the horizon that ends them, if
//! any.
struct RecordedPath {
  std::vector<CameraKey> keys;
  std::optional<RecordedFall> fall;
};

//! Records a flight as the camera path of a show.
class FlightRecorder {
 public:
  //! Adds a sample. Ignores samples whose time does not increase, with a non-finite pose, or with a
  //! velocity not below that of light. Keeps at most thirty per second, for an hour; then it is
  //! full.
  //!
  //! After a fall is beyond return, the recording ends at the first sample that is not later on the
  //! same orbit around the same hole: no path of a show leads elsewhere from there.
  void note(FlightSample sample);

  //! Ends the recording: later samples are ignored.
  void end() { ended_ = true; }

  [[nodiscard]] bool empty() const { return samples_.size() < 2; }
  [[nodiscard]] bool full() const;
  //! Returns whether the last sample belongs to a fall that cannot escape.
  [[nodiscard]] bool beyond_return() const;
  //! Returns whether the recording has ended, by leaving a fall through the horizon or by end().
  [[nodiscard]] bool ended() const { return ended_; }

  //! Returns the flight with few camera keys (min_keys()): camera_pose() of these keys is within
  //! the tolerance of every sample. The first key is at 0 s. The keys have velocities unless all
  //! samples have the scene's observer.
  //!
  //! If the camera fell through the horizon, the keys control its position only up to the beginning
  //! of that fall, and afterwards only its orientation. The path ends before the first sample
  //! beyond return if no beginning can be found, or if the hole had another spin than the scene's.
  [[nodiscard]] RecordedPath path(const Show& scene, const RecordTolerance& tolerance = {}) const;

 private:
  std::vector<FlightSample> samples_;
  bool ended_ = false;
};

//! Returns a show of a scene that follows a recorded path. The file names in this show are valid
//! from other folders.
Show recorded_show(const Show& scene, RecordedPath path, const std::string& title);

}  // namespace ergodome
