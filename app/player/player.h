#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "app/flight.h"
#include "app/player/picture_flow.h"
#include "app/player/player_screen.h"
#include "app/player/renderer_loader.h"
#include "app/player_keys.h"

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
class Player {
 public:
  //! `make` makes the renderer of a show: at the start, and whenever one is lost.
  Player(const Show& show, RendererLoader::Make make, const PlayOptions& options);
  ~Player();
  Player(const Player&) = delete;
  Player& operator=(const Player&) = delete;

  void run();

 private:
  using Clock = std::chrono::steady_clock;

  void handle(const WindowEvent& event);
  void press(int key);
  void advance(double seconds);
  void update_picture();
  void note(PictureNews news);
  void take_renderer();
  void say(const std::string& problem);
  void end_in_time();
  void print_statistics() const;
  [[nodiscard]] std::string panel_text() const;
  void update_title();
  [[nodiscard]] bool by_eye() const { return stereo_.layout == StereoLayout::quad_buffer; }
  [[nodiscard]] const Show& show() const { return show_; }
  [[nodiscard]] CameraPose current_pose() const;
  [[nodiscard]] ShowMoment moment() const;
  [[nodiscard]] bool moving() const;

  RendererLoader loader_;
  std::shared_ptr<ShowRenderer> renderer_;  //!< none while a lost one is made anew
  Show show_;
  PlayOptions options_;
  PlayerScreen screen_;
  PictureFlow pictures_;
  Flight flight_;
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
  std::string backend_;
  std::string said_problem_;
  std::optional<Clock::time_point> first_answer_;  //!< when the first picture, or the reason why there is none, came
};

}  // namespace ergodome
