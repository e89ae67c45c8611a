#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "app/exhibit/black_view.h"
#include "app/exhibit/exhibit_scenes.h"
#include "app/exhibit/operator_log.h"
#include "app/navigation/controls/help_text.h"
#include "app/pads/hid/hid_api.h"
#include "app/player/cluster_gate.h"
#include "app/player/eye_notice.h"
#include "app/player/frame_times.h"
#include "app/player/outputs/disparity_limit.h"
#include "app/player/outputs/headset_pad.h"
#include "app/player/outputs/threshold_pulses.h"
#include "app/player/player_inputs.h"
#include "app/player/player_services.h"
#include "app/player/player_session.h"
#include "app/player/recording_file.h"
#include "app/player/renderers/note_board.h"
#include "app/player/session_pictures.h"
#include "render/present/output.h"

namespace ergodome {

//! Options of `play`.
struct PlayOptions {
  bool free_flight = false;
  int size_px = 1024;  //!< width of one eye's image while nothing moves
  bool quiet = false;  //!< shows only text that keys request
  //! Ends this long after the first frame [s]; absent: runs until it is closed.
  std::optional<double> for_seconds;
  bool guide = false;        //!< inputs only move the camera forward and back
  bool haptics = true;       //!< the controllers of a headset vibrate at photon orbits and the horizon
  bool times_shown = false;  //!< shows the frame time and the lens over the picture
  std::string screenshot;    //!< last contents of the window (PNG); empty: none
  std::string language;
  //! Show file to record the flight to; in an exhibit, each flight gets a numbered file in the same
  //! folder; empty: none.
  std::string record;
  std::string controls;      //!< file of controls; empty: the user's
  std::string pad_settings;  //!< empty: the user's
  std::string pad_fixture;   //!< recorded controllers that replace connected ones
  ServiceOptions services;   //!< sound, clocks, remote control
  std::optional<ExhibitOptions> exhibit;
  std::optional<PlayPlan> budget;
  std::shared_ptr<ClusterGate> cluster;  //!< nodes that show the dome together with this player; null: none
  //! Notes from loading shows, for the log.
  std::shared_ptr<NoteBoard> notes = std::make_shared<NoteBoard>();
  //! Reads a show file and applies the options of the command line.
  std::function<Show(const std::string&)> load;
  //! No file of the shows was read before this time. Files that change later are loaded again.
  std::chrono::system_clock::time_point read_at = std::chrono::system_clock::now();
};

//! Plays a show, or flies through its scene, on an output.
class Player {
 public:
  //! `make` makes the renderer of a show: of the first one, of other scenes and versions, and again
  //! whenever one is lost.
  Player(const Show& show, const RendererLoader::Make& make, std::unique_ptr<DisplayOutput> output,
         const PlayOptions& options);
  ~Player();
  Player(const Player&) = delete;
  Player& operator=(const Player&) = delete;

  void run();

 private:
  using Clock = std::chrono::steady_clock;

  //! Starts a show from its beginning.
  void begin(const Show& show, bool free_flight);
  void advance();
  //! Lets the controllers of a headset vibrate where the camera crosses a threshold.
  void pulse_at_thresholds();
  void answer_requests();
  void reload(bool now);
  void take_renderer();
  //! Handle a new version of the show's file: one that has become current, and one that cannot be
  //! used.
  void take_version(const Show& show);
  void refuse_version(const std::string& problem);
  void report_notes();
  void update_picture();
  void note(PictureNews news);
  //! Pauses the show while nobody looks at the output, and lets an exhibit know when someone does.
  //! Returns whether someone began to look.
  bool follow_attention(PlayerInput& input);
  //! Adds the scale of a viewer's head, and the baseline of its eyes, to a request.
  void add_head(PictureRequest& wish);
  void report_reduced_baseline();
  //! Takes the disparities of the last picture for a viewer's eyes, if they were measured.
  void limit_disparity();
  //! `arrived`: a visitor began to look at the output in this frame.
  void advance_exhibit(PlayerInput& input, bool arrived);
  void change_scene();
  //! Requests the lit part of a visitor's view if it is due. Returns whether it is.
  bool add_light(PictureRequest& wish);
  void note_light();
  //! Adds the captions for visitors to a request. Returns whether they changed.
  bool add_words(PictureRequest& wish);
  [[nodiscard]] std::string help_text(HelpForm form) const;
  void update_texts();
  void post_status();
  //! Stores the operator's settings. A problem is logged, and also put into the status if that has
  //! no other problem.
  void keep_settings(PlayerStatus& status);
  enum class RecordingMoment { frame, end };
  //! Saves the recording: in each `frame` if it is due, at the `end` in any case. Logs a failure,
  //! and that saving works again.
  void keep_recording(RecordingMoment moment);
  void advance_cluster();
  //! Tells the nodes which shows they must have. `show`: the only one, without an exhibit.
  void set_cluster_shows(const Show& show);
  void end_in_time();
  //! Closes the output and stores the reason.
  void end(std::string why);
  //! Return what an exhibit's log says at the start and at the end.
  [[nodiscard]] std::string start_text() const;
  [[nodiscard]] std::string end_text() const;
  void print_statistics() const;

  PlayOptions options_;
  std::vector<std::string> damage_;  //!< errors of files that were ignored at the start
  std::unique_ptr<DisplayOutput> output_;
  OutputWish output_wish_;         //!< requirements of the output for the next picture
  bool attended_ = true;           //!< DisplayOutput::attended() of the last frame
  bool pauses_alone_ = false;      //!< the show is paused because nobody looks
  double head_baseline_ = 0.0;     //!< baseline of a viewer's eyes in the last request [M]
  glm::dvec3 head_offset_m_{0.0};  //!< ViewerHead::offset_m of the last request
  EyeNotice eye_notice_;
  DisparityLimit disparity_limit_;  //!< of a viewer's eyes
  std::optional<PlayerSession> session_;
  PlayerInputs inputs_;
  PadHub pads_;
  PadSnapshot pad_snapshot_;
  HeadsetPad headset_pad_;
  ThresholdPulses pulses_;
  SessionPictures pictures_;
  PlayerServices services_;
  std::optional<ExhibitScenes> exhibit_;
  OperatorLog operator_log_;
  LightWatch light_watch_;
  std::vector<LocalText> words_;  //!< captions for visitors in the picture
  double words_opacity_ = 0.0;
  FrameTimes frame_times_;
  //! When the first frame, or the error instead of it, came.
  std::optional<Clock::time_point> first_answer_;
  RecordingFile recording_;
  bool in_swap_group_ = false;
  std::string recording_problem_;  //!< why the last flight could not be written
  std::string why_ended_;          //!< reason if the program closed the window itself
};

}  // namespace ergodome
