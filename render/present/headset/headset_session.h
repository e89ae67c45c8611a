#pragma once

#include <array>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "kernels/projection/make_projection.h"
#include "render/output/stereo_layout.h"
#include "render/present/headset/headset_input.h"

// A session of a headset: its frames, the views of its eyes, and the images that it shows.

namespace ergodome {

//! Thrown when the headset or its runtime is gone. A new HeadsetSession may find it again.
class HeadsetLost : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

//! How the runtime treats the session's frames.
enum class HeadsetState {
  waiting,  //!< the session has not begun, or was stopped; there are no frames
  hidden,   //!< frames are not shown, for example because nobody wears the headset
  visible,  //!< frames are shown, and input goes to another program
  focused,  //!< frames are shown, and input comes here
  ended     //!< the user ended the session from the runtime's menu
};

//! The origin of positions: the middle of the floor, or a head at rest.
enum class HeadsetOrigin { floor, head };

//! The view of an eye when a frame is displayed, in the axes of the room (x right, y up, z back).
struct HeadsetEye {
  glm::dquat turn{1.0, 0.0, 0.0, 0.0};  //!< rotates the eye's axes into those of the room
  glm::dvec3 position_m{0.0};
  FrustumSides sides{-1.0, 1.0, 1.0, -1.0};  //!< tangents of the view's sides
};

using HeadsetEyes = std::array<HeadsetEye, 2>;

//! A frame that the runtime waits for.
struct HeadsetFrame {
  std::int64_t display_time_ns = 0;  //!< predicted time of the display, by the runtime's clock
  double delay_s = 0.0;              //!< time from now until then
  double period_s = 0.0;             //!< time between frames
  bool drawn = false;                //!< false: the runtime shows no picture of this frame
};

//! A connection to the active OpenXR runtime and its headset. All functions need the OpenGL context
//! with which it was made to be current, and leave it current. Those that call the runtime throw
//! HeadsetLost when the headset is lost, and Error for other failures.
class HeadsetSession {
 public:
  //! Uses the current context of GLX. Throws Error if there is no loader, runtime or headset, or if
  //! the program was built without OpenXR.
  HeadsetSession();
  ~HeadsetSession();
  HeadsetSession(const HeadsetSession&) = delete;
  HeadsetSession& operator=(const HeadsetSession&) = delete;

  //! Handles the events of the runtime: begins and ends the session as it asks.
  void poll();
  [[nodiscard]] HeadsetState state() const;

  //! Waits until the runtime wants the next frame, and begins it. Returns nothing while there are
  //! no frames (HeadsetState::waiting); then it does not wait.
  std::optional<HeadsetFrame> begin_frame();

  //! Returns the eyes' views for the frame's display time, the left eye first; nothing while their
  //! orientation is not known.
  [[nodiscard]] std::optional<HeadsetEyes> locate();

  //! Returns the texture to draw an eye's picture of this frame into. Call end_eye() when that is
  //! done.
  unsigned begin_eye(int eye);
  void end_eye(int eye);

  //! Ends the frame. With `eyes`, which must be the result of locate(), it shows both pictures;
  //! otherwise none.
  void end_frame(const std::optional<HeadsetEyes>& eyes);

  //! Returns the state of both controllers; at rest unless the session is focused.
  [[nodiscard]] HeadsetHands hands();
  //! Lets a hand's controller vibrate: 0 is the left one. `strength`: 0 to 1.
  void pulse(int hand, double seconds, double strength);

  //! Returns the size of an eye's picture.
  [[nodiscard]] ImageSize eye_size() const;
  //! Returns whether pictures are stored as sRGB values; otherwise as linear light.
  [[nodiscard]] bool encoded() const;
  [[nodiscard]] HeadsetOrigin origin() const;
  //! Returns whether the origin has moved since the last call, because the user recentered.
  [[nodiscard]] bool take_recentered();
  //! Returns the names of the runtime and of the headset.
  [[nodiscard]] std::string name() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace ergodome
