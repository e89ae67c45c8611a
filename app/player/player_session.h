#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/navigation/controls/actions.h"
#include "app/navigation/navigator.h"
#include "app/navigation/observer_mode.h"
#include "app/playback/playback.h"
#include "app/player/recording/flight_recorder.h"
#include "app/player/renderers/player_frame.h"

namespace ergodome {

//! What people did since the last frame.
struct PlayerInput {
  SteeringInput steering;
  std::vector<KeyAction> actions;          //!< of keys, pads and the mouse
  std::vector<TransportCommand> commands;  //!< of OSC and of the page
};

struct SessionOptions {
  bool free_flight = false;
  std::string language;       //!< empty: the show's own
  bool one_eye = false;       //!< what is shown is the head's picture: eyes cannot be changed
  bool plain_window = false;  //!< it has no buffers for each eye: eyes that ask for them are side by side
  TimeSource source = steady_time;
};

//! A show that is playing, or is flown through: all of the player but its windows, its threads and its pictures.
class PlayerSession {
 public:
  PlayerSession(const Show& show, SessionOptions options);

  //! Goes on with another version of the show: time and what was set stay; a camera in free flight starts anew.
  void set_show(const Show& show);

  //! Once a frame.
  void advance(const PlayerInput& input);

  [[nodiscard]] const PlayerFrame& frame() const { return frame_; }
  //! Whether the last `advance` called for another picture than the one before.
  [[nodiscard]] bool changed() const { return changed_; }
  //! Whether it will change again at once.
  [[nodiscard]] bool moving() const;
  [[nodiscard]] bool flying() const { return navigator_->course() != Navigator::Course::path; }
  //! When anybody did something last: by the clock of the options [s].
  [[nodiscard]] double touched_s() const { return touched_s_; }
  [[nodiscard]] double now_s() const { return seconds_of(playback_.instant().now); }

  //! Calls for the picture once more: its renderer is another one.
  void show_again() { begun_ = false; }
  //! A stereo layout in place of the show's.

  //! Shows a line for a while.
  void say(std::string message);

  //! What was asked for and is not the session's matter, since the last call: quit, full_screen, reload, leave_exhibit.
  [[nodiscard]] std::vector<KeyAction> take_requests();

  [[nodiscard]] bool help_shown() const { return help_shown_; }
  [[nodiscard]] bool times_shown() const { return times_shown_; }
  void show_times(bool shown) { times_shown_ = shown; }
  //! Lines about the way of flying and who looks, and what was changed last; empty on the show's path a while after.
  [[nodiscard]] std::string caption() const;

  //! From now on the flight is written down; what was so far is forgotten.
  void record();
  //! The flight as a show; nothing while there is none.
  [[nodiscard]] std::optional<Show> recorded(const std::string& title) const;
  [[nodiscard]] bool recording_full() const { return recorder_ && recorder_->full(); }

  void fill(PlayerStatus& status) const;
  [[nodiscard]] Playback& playback() { return playback_; }
  [[nodiscard]] const Playback& playback() const { return playback_; }
  [[nodiscard]] const Show& show() const { return show_; }
  //! The hole's spin as it is now.
  [[nodiscard]] double spin() const { return show_now_.spin; }

 private:
  void apply(const TransportCommand& command);
  void press(KeyAction action);
  void press_view(KeyAction action);
  void adjust_stereo(KeyAction action);
  void tell_of_replaced_eyes();
  void navigate(const PlayerInput& input, double seconds);
  //! `shown_time_s`: the time of the show that the frame before had.
  void look(double seconds, double shown_time_s);
  //! Whether a caption that is to be seen, or an overlay, is there at a time of the show.
  [[nodiscard]] bool has_words_at(double time_s) const;
  //! Chooses who looks, and at what velocity, from where the camera is at a time of the show.
  void observe(double seconds, double time_s);
  //! How the camera itself moves, where that decides who looks; `in_zamo` is its pose.
  [[nodiscard]] std::optional<ObserverView> own_observer(const CameraPose& in_zamo, double time_s) const;
  //! Has another observer than the one who falls look from the frame's pose. Towards the horizon the other goes over into who falls: through it
  //! nobody else goes, and nothing is to leap there.
  void look_as_other(const CameraPose& in_zamo);
  //! Who looks from a path that has a velocity.
  [[nodiscard]] ObserverView observer_at(const Vector3<double>& velocity) const;
  //! The own time of a camera that falls through the horizon [M]; nothing where it does not, or somebody else looks.
  [[nodiscard]] std::optional<double> own_time_of_fall();
  //! Notes the frame's pose, and how who looks moves.
  void note_flight();
  //! Ends a record that is beyond return, of a flight in this scene: in a hole of another spin its fall does not go on.
  void end_record_in(const Show& scene);
  //! Says that a fall has ended the record, which is a show of this scene.
  void tell_record_ends(const Show& scene);
  //! The show with its numbers as they are now, and the eyes that who operates has chosen.
  [[nodiscard]] Show scene_now() const;
  //! What the show says and who operates has chosen.
  [[nodiscard]] StereoSettings chosen_stereo() const;
  //! The same, with eyes that may be where the camera is.
  [[nodiscard]] StereoSettings stereo_now() const;
  [[nodiscard]] double field_of_view_deg() const;

  SessionOptions options_;
  Show show_;      //!< as its file has it
  Show show_now_;  //!< with its numbers as they are now
  Playback playback_;
  std::optional<Navigator> navigator_;
  ObserverMode observer_ = ObserverMode::natural;
  ObserverFade observer_fade_;
  double other_eyes_from_r_ = 1e300;  //!< where the camera began to fall through the horizon [M]
  std::optional<FlightRecorder> recorder_;
  std::optional<Show> ended_record_scene_;  //!< what the show was when a fall through the horizon ended the record
  double own_time_before_ride_ = 0.0;       //!< of a camera that was taken from a falling path [M]

  ViewMode mode_ = ViewMode::sky;
  double zoom_steps_ = 0.0;
  StereoSettings stereo_;              //!< as a person set it, but for the next two
  std::optional<double> convergence_;  //!< in place of the show's [M]
  bool help_shown_ = false;
  bool times_shown_ = false;
  std::string message_;
  double message_until_s_ = -1.0;
  bool told_of_replaced_eyes_ = false;

  PlayerFrame frame_;
  bool begun_ = false;
  bool changed_ = true;
  double touched_s_ = -1e300;
  std::vector<KeyAction> requests_;
};

}  // namespace ergodome
