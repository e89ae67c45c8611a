#pragma once

#include <optional>
#include <string>

#include "app/navigation/navigator.h"
#include "app/navigation/observer_mode.h"
#include "app/player/renderers/player_frame.h"

namespace ergodome {

//! The inputs that determine the observer of a frame.
struct ObserverScene {
  const Show& show;     //!< the show with the numbers of its file, before animation
  Spacetime spacetime;  //!< the current spacetime
  double time_s;        //!< show time
  const Navigator& navigator;
  const std::string& language;
};

//! The observer of a session's frames: the show's, the camera's own, or one that a user chooses.
class SessionObserver {
 public:
  //! Chooses the next observer for a camera at a pose. Changes nothing inside the horizon, where
  //! only the infalling observer is possible.
  void choose_next(const CameraPose& pose, Spacetime spacetime);
  void reset() { mode_ = ObserverMode::natural; }
  [[nodiscard]] bool is_chosen() const { return mode_ != ObserverMode::natural; }

  //! Sets a frame's observer. The frame must have the navigator's pose, which is adapted if the
  //! observer is not the infalling one.
  void observe(double seconds, const ObserverScene& scene, PlayerFrame& frame);

 private:
  //! Changes a frame to another observer than the infalling one. Toward the horizon, blends into
  //! the infalling observer, because no other can cross it and the view must not jump there.
  void replace_observer(const ObserverScene& scene, const CameraPose& in_zamo, PlayerFrame& frame) const;

  ObserverMode mode_ = ObserverMode::natural;
  ObserverFade fade_;
  double plunge_start_r_ = 1e300;  //!< radius at which the camera began to fall through the horizon [M]
};

}  // namespace ergodome
