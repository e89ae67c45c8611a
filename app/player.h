#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "app/flight.h"
#include "app/frame_source.h"
#include "render/present/presenter.h"
#include "render/present/projector_windows.h"
#include "render/present/text_panel.h"
#include "render/present/window.h"

namespace ergodome {

struct PlayOptions {
  bool full_screen = false;
  bool free_flight = false;
  int size_px = 1024;                        //!< width of one eye's image when the picture stands still
  double for_seconds = 0.0;                  //!< ends by itself this long after the first picture; 0: when it is closed
  bool times_shown = false;                  //!< writes the frame time and the lens over the picture
  std::string screenshot;                    //!< what the window showed last, as a PNG; empty: none
  std::optional<DomeSetup> setup;            //!< of a dome whose projectors show the pictures, too
  std::vector<ProjectorPicture> projectors;  //!< of the setup
  bool hide_control = false;                 //!< with a setup: the projectors' windows alone are to be seen
};

//! Plays a show, or flies through its scene, in a window.
//!
//! On the CPU pictures are rendered beside the window's own thread: as wide as the time allows while something moves (10 pictures
//! a second or more), then finer and finer while all stands still. On a GPU each picture is rendered whole and shown without a way
//! through the host.
class Player {
 public:
  Player(ShowRenderer& renderer, const PlayOptions& options);
  ~Player();
  Player(const Player&) = delete;
  Player& operator=(const Player&) = delete;

  void run();

 private:
  using Clock = std::chrono::steady_clock;

  void handle(const WindowEvent& event);
  void press(int key);
  void advance(double seconds);
  void ask_for_picture();
  void show_on_device();
  void receive();
  void note_answer();
  void write_panel(int size_px, const std::optional<Disparity>& disparity);
  void draw();
  void draw_window(int width, int height);
  void update_title();
  void save_screenshot();
  [[nodiscard]] bool closed() const;
  [[nodiscard]] std::vector<WindowEvent> events();
  [[nodiscard]] CameraPose current_pose() const;
  [[nodiscard]] ShowMoment moment() const;
  [[nodiscard]] bool moving() const;

  ShowRenderer& renderer_;
  PlayOptions options_;
  Window window_;
  Presenter presenter_;
  TextPanel panel_;
  std::unique_ptr<ProjectorWindows> projectors_;  //!< where there is a setup
  Flight flight_;
  std::unique_ptr<FrameSource> source_;
  std::set<int> held_keys_;
  double show_time_s_ = 0.0;
  bool paused_ = false;
  bool flying_ = false;
  bool changed_ = true;
  bool times_shown_ = false;  //!< over the picture: a full screen has no title
  ViewMode mode_ = ViewMode::sky;
  StereoSettings shown_stereo_;  //!< as the show has it
  StereoSettings stereo_;
  double field_of_view_deg_ = 0.0;
  int moving_size_px_ = 256;  //!< what keeps ten pictures a second
  int refined_size_px_ = 0;   //!< width of the last picture of what stands still
  double frame_time_ms_ = 0.0;
  const char* lens_ = "";  //!< where the last picture's lens came from
  std::string said_problem_;
  std::optional<Clock::time_point> first_answer_;  //!< when the first picture, or the reason why there is none, came
  int pictures_ = 0;
};

}  // namespace ergodome
