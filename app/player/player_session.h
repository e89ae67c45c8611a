#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/navigation/controls/actions.h"
#include "app/navigation/navigator.h"
#include "app/playback/playback.h"
#include "app/player/recording/session_recording.h"
#include "app/player/renderers/player_frame.h"
#include "app/player/session_observer.h"

namespace ergodome {

//! User input since the last frame.
struct PlayerInput {
  SteeringInput steering;
  std::vector<KeyAction> actions;          //!< actions triggered by keys, controllers and the mouse
  std::vector<TransportCommand> commands;  //!< commands from OSC and the status page
  double display_delay_s = 0.0;            //!< OutputWish::display_delay_s
  //! ViewerHead::look, if a viewer's head determines where the camera looks.
  std::optional<glm::dquat> look = std::nullopt;
};

struct SessionOptions {
  bool free_flight = false;
  std::string language;  //!< language of the texts; empty: the show's
  bool one_eye = false;  //!< the head's picture is shown, so the eyes cannot be changed
  //! True if the window has no separate eye buffers; layouts that need them are then shown side by
  //! side.
  bool plain_window = false;
  TimeSource source = steady_time;
};

//! A show that is played or flown through: the player without its windows, threads and renderers.
class PlayerSession {
 public:
  PlayerSession(const Show& show, SessionOptions options);

  //! Continues with another version of the show. Keeps the time, the baseline and the other
  //! settings of playback(). Restores the show's other stereo settings, and restarts a camera in
  //! free flight.
  void set_show(const Show& show);

  //! Advances by one frame.
  void advance(const PlayerInput& input);

  [[nodiscard]] const PlayerFrame& frame() const { return frame_; }
  //! Returns whether the last `advance` requires another picture than the one before.
  [[nodiscard]] bool changed() const { return changed_; }
  //! Returns whether the next frame may need another picture: the last one changed, the camera
  //! moves, or the show plays and the camera is on its path.
  [[nodiscard]] bool moving() const;
  [[nodiscard]] bool flying() const { return navigator_->course() != Navigator::Course::path; }
  //! Returns when the last input came, by the clock of the options [s].
  [[nodiscard]] double touched_s() const { return touched_s_; }
  [[nodiscard]] double now_s() const { return seconds_of(playback_.instant().now); }

  //! Forces a redraw after the renderer was replaced.
  void show_again() { begun_ = false; }

  //! Shows a line for a few seconds.
  void say(std::string message);

  //! Returns the requests since the last call that the player, not the session, handles: quit,
  //! full_screen, reload, leave_exhibit.
  [[nodiscard]] std::vector<KeyAction> take_requests();

  [[nodiscard]] bool help_shown() const { return help_shown_; }
  [[nodiscard]] bool times_shown() const { return times_shown_; }
  void show_times(bool shown) { times_shown_ = shown; }
  //! Returns lines about the flight mode, the observer and the latest message. On the show's path,
  //! empty unless an observer was chosen or a message is shown.
  [[nodiscard]] std::string caption() const;

  //! Starts recording the flight; discards an earlier recording.
  void record() { recording_.begin(); }
  //! Returns the recorded flight as a show; nothing if there is none.
  [[nodiscard]] std::optional<Show> recorded(const std::string& title) const;
  [[nodiscard]] bool recording_full() const { return recording_.full(); }

  void fill(PlayerStatus& status) const;
  [[nodiscard]] Playback& playback() { return playback_; }
  [[nodiscard]] const Playback& playback() const { return playback_; }
  [[nodiscard]] const Show& show() const { return show_; }
  //! Returns the hole's current spin.
  [[nodiscard]] Spacetime spacetime() const { return spacetime_of(show_now_); }

 private:
  void apply(const TransportCommand& command);
  void press(KeyAction action);
  void press_view(KeyAction action);
  void adjust_stereo(KeyAction action);
  void report_replaced_eyes();
  void navigate(const PlayerInput& input, double seconds);
  //! Returns the show time for which the next picture is rendered: that of the clock, plus the
  //! change of show time during the display's delay, up to the end of the show; 0 if the show has
  //! no duration.
  [[nodiscard]] double picture_time_s() const;
  //! Updates the frame. `shown_time_s` is the show time of the previous frame.
  void update_frame(double seconds, double shown_time_s);
  //! Returns whether a visible caption or an overlay is present at a show time.
  [[nodiscard]] bool has_words_at(double time_s) const;
  //! Ends the recording after a fall through the horizon has ended the flight; the recording
  //! becomes a show of this scene.
  void end_recording(const Show& scene);
  //! Returns the show with its current numbers and the operator's stereo settings.
  [[nodiscard]] Show scene_now() const;
  //! Returns the show's stereo settings with the operator's changes.
  [[nodiscard]] StereoSettings chosen_stereo() const;
  //! Returns chosen_stereo() without what cannot be shown. Replaces the quad-buffer layout by side
  //! by side in a plain window, and the model `flat` by another if the show or the flight leads
  //! through the horizon.
  [[nodiscard]] StereoSettings stereo_now() const;
  [[nodiscard]] double field_of_view_deg() const;

  SessionOptions options_;
  Show show_;      //!< the show before its numbers are animated
  Show show_now_;  //!< the show with its numbers at the current show time
  Playback playback_;
  std::optional<Navigator> navigator_;
  SessionObserver observer_;
  SessionRecording recording_;

  ViewMode mode_ = ViewMode::sky;
  double zoom_steps_ = 0.0;
  //! The operator's stereo settings, except the baseline (in `playback_`) and the convergence.
  StereoSettings stereo_;
  std::optional<double> convergence_;  //!< the operator's convergence distance; replaces the show's [M]
  bool help_shown_ = false;
  bool times_shown_ = false;
  std::string message_;
  double message_until_s_ = -1.0;
  bool reported_replaced_eyes_ = false;

  PlayerFrame frame_;
  bool begun_ = false;
  bool changed_ = true;
  double touched_s_ = -1e300;
  double display_delay_s_ = 0.0;  //!< display delay that the last input gave
  std::vector<KeyAction> requests_;
};

}  // namespace ergodome
