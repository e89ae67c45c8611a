#pragma once

#include <set>
#include <span>
#include <vector>

#include "app/navigation/controls/controls.h"
#include "app/pads/pad_hub.h"
#include "app/player/player_session.h"
#include "render/present/window.h"

namespace ergodome {

//! Who may do what: everybody everything, or visitors of an exhibit what is for them.
enum class InputLock { open, visitors };

//! Makes of windows' events and of pads what a session understands.
class PlayerInputs {
 public:
  explicit PlayerInputs(Controls controls) : controls_(std::move(controls)) {}

  void set_lock(InputLock lock) { lock_ = lock; }

  //! What came since the last frame. `radians_per_px`: angle of the view that a pixel of the window is.
  [[nodiscard]] PlayerInput gather(std::span<const WindowEvent> events, const PadSnapshot& pads, double radians_per_px);

  //! Whether somebody did anything in the last frame, bound or not: a visitor is there.
  [[nodiscard]] bool touched() const { return touched_; }

  //! Whether the operator's chord is held: Ctrl + Alt + Q, keys that are bound to leaving the exhibit, or select, start and both shoulders of a pad.
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
  std::set<int> spent_keys_;  //!< those of them that went down for an action
  std::set<int> held_buttons_;
  PadState pad_before_;
  bool touched_ = false;
  bool chord_held_ = false;
};

}  // namespace ergodome
