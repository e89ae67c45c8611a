#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/player/outputs/window_output.h"
#include "content/show/headset_settings.h"
#include "render/present/headset/comfort.h"
#include "render/present/headset/eye_painter.h"
#include "render/present/headset/frame_motion.h"
#include "render/present/headset/headset_session.h"
#include "render/present/headset/panorama.h"
#include "render/present/headset/snap_turns.h"

namespace ergodome {

struct HeadsetOptions {
  WindowOptions mirror;  //!< window that shows an operator the left eye's view
  //! True: without a headset, the show runs in the window until one is connected.
  bool may_be_absent = false;
};

//! A headset, through OpenXR. The player renders the whole sky of a position; each frame of the
//! headset draws both eyes from it with the newest pose of the head, also while the next position
//! is being rendered.
class HeadsetOutput : public DisplayOutput {
 public:
  //! Throws Error if there is no display, or no headset and it may not be absent.
  explicit HeadsetOutput(const HeadsetOptions& options);
  ~HeadsetOutput() override;

  [[nodiscard]] OutputWish wish() override;
  void take(OutputFrame& frame) override;
  void set_light(double light) override { light_ = light; }
  void show() override;
  [[nodiscard]] bool closed() const override;
  void close() override { window_.close(); }
  [[nodiscard]] bool sets_pace() const override { return true; }
  [[nodiscard]] std::vector<WindowEvent> events() override;
  [[nodiscard]] ImageSize size() const override;
  void toggle_full_screen() override { window_.toggle_full_screen(); }
  void set_title(const std::string& title) override { window_.set_title(title); }
  void set_text(PanelPosition position, const std::string& text) override;
  void save_screenshot(const std::string& file) override;
  void set_headset(const HeadsetSettings& settings) override;
  void turn_viewer(double rate) override;
  [[nodiscard]] std::optional<HeadsetHands> hands() override;
  void pulse(double seconds, double strength) override;
  [[nodiscard]] bool attended() const override;
  [[nodiscard]] std::string state_text() const override;

  //! Returns the width of a picture whose pixels are as small as those of the headset [px].
  [[nodiscard]] int fitting_size_px() const;

 private:
  void connect();
  void lose(const std::string& problem);
  //! Runs a call of the session; if the headset is lost, ends the session.
  template <class Work>
  void with_session(const Work& work);
  //! Makes the viewer's next position and direction the middle and the front.
  void recenter() { centered_ = false; }
  void follow_head();
  void draw_frame();
  void draw_mirror();
  [[nodiscard]] HeadsetScene scene() const;
  [[nodiscard]] glm::dquat level_from_room() const;

  HeadsetOptions options_;
  HeadsetSettings settings_;
  Window window_;
  Panorama panorama_;
  EyePainter painter_;
  std::optional<HeadsetSession> session_;
  double next_try_s_ = 0.0;
  std::string problem_;  //!< why there is no session

  std::optional<HeadsetFrame> frame_;  //!< begun and not yet ended
  HeadsetEyes eyes_;                   //!< eyes as last located
  bool located_ = false;               //!< whether the eyes were ever located
  bool centered_ = false;
  bool menu_held_ = false;
  glm::dvec3 middle_m_{0.0};  //!< position of the head when it was centered
  double facing_ = 0.0;       //!< its direction, to the left of the room's front [rad]
  double first_yaw_ = 0.0;    //!< ComfortState::yaw_rad at that time
  double turn_step_ = 0.0;    //!< direction between the eyes in the last wish, in level axes [rad]

  HeadsetComfort comfort_{settings_};
  ComfortState comfort_state_;
  SnapTurns snap_turns_;
  int snap_steps_ = 0;
  double turn_rate_ = 0.0;  //!< turn_viewer(): rate of the last call
  FrameMotion motion_;
  double light_ = 1.0;
  double advanced_s_ = 0.0;
  double mirrored_s_ = -1.0;
  unsigned framebuffer_ = 0;
  std::map<PanelPosition, std::string> texts_;
};

}  // namespace ergodome
