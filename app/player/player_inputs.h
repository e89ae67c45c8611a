#pragma once

#include <set>
#include <span>
#include <vector>

#include "app/navigation/controls/controls.h"
#include "app/pads/pad_hub.h"
#include "app/player/player_session.h"
#include "render/present/window.h"

namespace ergodome {

//! Which inputs have an effect: all; steering and the actions for visitors of an exhibit; or only
//! steering forward and back. Does not concern the operator's commands by OSC and the status page.
enum class InputLock { open, visitors, guide };

//! Converts the events of windows and controllers to the input of a session.
class PlayerInputs {
 public:
  explicit PlayerInputs(Controls controls) : controls_(std::move(controls)) {}

  void set_lock(InputLock lock) { lock_ = lock; }

  //! Returns the input since the last frame. `radians_per_px` is the angle of view per pixel of the
  //! window.
  [[nodiscard]] PlayerInput gather(std::span<const WindowEvent> events, const PadSnapshot& pads, double radians_per_px);

  //! Returns whether there was any input in the last frame, bound or not, or a key or button was
  //! held, which means that a visitor is present.
  [[nodiscard]] bool touched() const { return touched_; }

  //! Returns whether the operator's chord is held: Ctrl + Alt + Q, keys bound to leaving the
  //! exhibit, or select, start and both shoulder buttons of a controller.
  [[nodiscard]] bool chord_held() const { return chord_held_; }

  [[nodiscard]] const Controls& controls() const { return controls_; }

 private:
  void press(int key, PlayerInput& input);
  void take(const WindowEvent& event, MouseState& mouse, PlayerInput& input);
  void take_pads(const PadSnapshot& pads, PlayerInput& input);
  void find_chord(const PadState& pad);
  void add(const std::vector<KeyAction>& actions, PlayerInput& input) const;

  Controls controls_;
  InputLock lock_ = InputLock::open;
  std::set<int> held_keys_;
  std::set<int> spent_keys_;  //!< held keys whose press triggered an action; they do not steer
  std::set<int> held_buttons_;
  PadState pad_before_;
  bool touched_ = false;
  bool chord_held_ = false;
};

}  // namespace ergodome
