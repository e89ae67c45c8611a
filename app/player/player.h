#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>

#include "app/budget/play_budget.h"
#include "app/exhibit/exhibit_scenes.h"
#include "app/exhibit/operator_log.h"
#include "app/navigation/controls/controls.h"
#include "app/pads/hid/hid_api.h"
#include "app/player/eye_notice.h"
#include "app/player/frame_times.h"
#include "app/player/note_board.h"
#include "app/player/player_inputs.h"
#include "app/player/player_screen.h"
#include "app/player/player_services.h"
#include "app/player/player_session.h"
#include "app/player/recording/recording_file.h"
#include "app/player/renderers/picture_flow.h"
#include "app/player/renderers/scene_renderers.h"

namespace ergodome {

struct PlayOptions {
  bool full_screen = false;
  bool free_flight = false;
  int size_px = 1024;                 //!< width of one eye's image when the picture stands still
  bool quiet = false;                 //!< says nothing on the screen but what keys ask for
  std::optional<double> for_seconds;  //!< ends by itself this long after the first picture; absent: when it is closed
  bool times_shown = false;           //!< writes the frame time and the lens over the picture
  std::string screenshot;             //!< what the window showed last, as a PNG; empty: none
  std::optional<DomeSetup> setup;     //!< of a dome whose projectors show the pictures, too
  std::vector<ProjectorPicture> projectors;  //!< of the setup
  int projectors_px = 0;                     //!< enough_master_px() of them
  bool hide_control = false;                 //!< with a setup: the projectors' windows alone are to be seen
  std::string language;
  std::string
      record;  //!< a show file that the flight is written to, an exhibit's each to one of its own beside it; empty: none
  std::string controls;      //!< a map of controls; empty: the user's own
  std::string pad_settings;  //!< empty: the user's own
  std::string pad_fixture;   //!< recorded pads in place of those that are plugged in
  ServiceOptions services;   //!< sound, clocks, remote control
  std::optional<ExhibitOptions> exhibit;
  std::optional<PlayPlan> budget;
  std::shared_ptr<NoteBoard> notes = std::make_shared<NoteBoard>();  //!< what loading shows has to tell, for the log
  std::function<Show(const std::string&)> load;  //!< reads a show's file and makes it what the command line asks for
  //! Shows are as their files were then, or later.
  std::chrono::system_clock::time_point read_at = std::chrono::system_clock::now();
};

//! Plays a show, or flies through its scene, in a window.
class Player {
 public:
  //! `make` makes the renderer of a show: at the start, and whenever one is lost.
  Player(const Show& show, const RendererLoader::Make& make, const PlayOptions& options);
  ~Player();
  Player(const Player&) = delete;
  Player& operator=(const Player&) = delete;

  void run();

 private:
  using Clock = std::chrono::steady_clock;

  //! Goes on with a show, from its start.
  void begin(const Show& show, bool free_flight);
  void advance();
  void answer_requests();
  void reload(bool now);
  void take_renderer();
  //! A version of the show is the one that runs from now on, or cannot be.
  void take_version(const Show& show);
  void refuse_version(const std::string& problem);
  void tell_notes();
  void update_picture();
  void note(PictureNews news);
  void tell_narrowed_eyes();
  void advance_exhibit(PlayerInput& input);
  void change_scene();
  //! Whether the window is to be drawn: at once, but for a rate only with each new picture, and now and then for its texts.
  bool draws_now();
  //! Puts the window's size into a wish; whether it is another one than before.
  bool add_window(PictureRequest& wish);
  //! Puts what the budget asks of the next picture into a wish.
  void add_budget(PictureRequest& wish);
  void note_budget();
  //! Asks for the lit part of a visitor's view where it changed since that was last measured, at most once a second. Returns whether it did.
  bool add_light(PictureRequest& wish);
  void note_light();
  //! Puts what visitors are to read into the picture; whether that is something else than before.
  bool add_words(PictureRequest& wish);
  [[nodiscard]] std::string help_text(HelpForm form) const;
  void update_texts();
  void post_status();
  //! Keeps what an operator has set; why that cannot be is told in the log, and in the status where there is no other problem.
  void keep_settings(PlayerStatus& status);
  enum class RecordingMoment { frame, end };
  //! What cannot be written is told in the log.
  void keep_recording(RecordingMoment moment);
  void end_in_time();
  //! Closes the window, and keeps why.
  void end(std::string why);
  //! For an exhibit's log: what begins, and why it has ended.
  [[nodiscard]] std::string start_text() const;
  [[nodiscard]] std::string end_text() const;
  void print_statistics() const;

  PlayOptions options_;
  std::vector<std::string> damage_;  //!< of files that were left out at the start
  PlayerScreen screen_;
  SceneRenderers renderers_;
  EyeNotice eye_notice_;
  std::optional<PlayerSession> session_;
  PlayerInputs inputs_;
  PadHub pads_;
  PadSnapshot pad_snapshot_;
  PictureFlow pictures_;
  PlayerServices services_;
  std::optional<ExhibitScenes> exhibit_;
  OperatorLog operator_log_;
  double view_changed_s_ = 0.0;  //!< when the session last asked for another picture
  double scene_began_s_ = 0.0;
  double light_noted_s_ = -1e300;  //!< ViewLight::asked_s of the last answer
  std::vector<LocalText> words_;   //!< in the picture, for visitors
  double words_opacity_ = 0.0;
  std::optional<ImageSize> window_;  //!< as it was last seen
  int failures_ = 0;                 //!< pictures that failed in a row
  FrameTimes frame_times_;
  std::optional<Clock::time_point> first_answer_;  //!< when the first picture, or the reason why there is none, came
  RecordingFile recording_;
  std::string recording_problem_;  //!< why the last flight could not be written
  std::optional<PlayBudget> budget_;
  std::string why_ended_;     //!< where the program closed the window itself
  long drawn_pictures_ = -1;  //!< of which the last is in the window
  double drawn_s_ = 0.0;      //!< when the window was drawn
};

}  // namespace ergodome
