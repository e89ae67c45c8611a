#pragma once

#include <optional>
#include <string>

#include "app/navigation/navigator.h"
#include "app/player/recording/flight_recorder.h"
#include "app/player/renderers/player_frame.h"

namespace ergodome {

//! The recording of a session's flight, until a fall through the horizon ends it.
class SessionRecording {
 public:
  //! Starts recording; discards an earlier recording.
  void begin();

  //! Records the pose of a frame in this spacetime, and the observer's velocity. Returns
  //! whether a fall has ended the recording; end() must follow.
  bool note(double now_s, const PlayerFrame& frame, const Navigator& navigator, const Show& show, Spacetime spacetime);

  //! Returns whether the flight is beyond return, so that it cannot continue around another hole.
  [[nodiscard]] bool is_bound_to_hole() const { return recorder_ && recorder_->beyond_return() && !ended_in_; }
  //! Ends the recording; recorded() then returns the flight as a show of this scene.
  void end(const Show& scene);

  //! Returns the recorded flight as a show in a scene; nothing if there is none.
  [[nodiscard]] std::optional<Show> recorded(const Show& scene, const std::string& title) const;
  [[nodiscard]] bool full() const { return recorder_ && recorder_->full(); }

 private:
  //! Returns the proper time that has passed since a camera began to fall through the horizon [M].
  //! Returns nothing if it does not fall, or if another observer is chosen.
  [[nodiscard]] std::optional<double> proper_time_of_fall(const PlayerFrame& frame, const Navigator& navigator,
                                                          const Show& show);

  std::optional<FlightRecorder> recorder_;
  std::optional<Show> ended_in_;          //!< the scene when a fall ended the recording
  double proper_time_before_ride_ = 0.0;  //!< proper time of the path's fall when a ride takes it over [M]
};

}  // namespace ergodome
