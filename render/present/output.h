#pragma once

#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <string>
#include <vector>

#include "calibration/projectors/projector_picture.h"
#include "content/camera/camera_path.h"
#include "content/show/headset_settings.h"
#include "kernels/projection/projection.h"
#include "render/output/stereo_layout.h"
#include "render/passes/overlay/caption_layer.h"
#include "render/picture/picture.h"
#include "render/present/headset/headset_input.h"
#include "render/present/text_panel.h"
#include "render/present/window.h"

// The interface of everything that gets finished frames: files, a window, the projectors of a dome,
// a headset.

namespace ergodome {

//! An eye whose view the output defines, such as an eye of a headset or a screen of a cluster.
struct OutputEye {
  //! Position along the eye's own x axis, to the right of the head, in baselines: -0.5 or 0.5.
  double side = 0.0;
  glm::dquat turn{1.0, 0.0, 0.0, 0.0};  //!< rotates the head's axes into the eye's
  Projection projection;                //!< frustum or other projection, and the picture's size
};

//! A flat panel for captions.
struct CaptionPanel {
  ImageSize size = {0, 0};  //!< [px]
  double half_width = 1.0;  //!< tangent of the angle from the panel's middle to its side

  bool operator==(const CaptionPanel&) const = default;
};

//! A viewer's head, whose orientation replaces that of the camera. Its axes (x right, y up, z back)
//! relate to the level axes of the observer: x along e_φ, y along -e_θ (up along the spin axis), z
//! along e_r, so that the hole is in front.
struct ViewerHead {
  glm::dquat look{1.0, 0.0, 0.0, 0.0};  //!< rotates the head's axes into the level axes, for steering
  //! Rotates the axes of the pictures into the level axes. It changes only when pictures with
  //! another direction between the eyes are needed.
  glm::dquat turn{1.0, 0.0, 0.0, 0.0};
  glm::dvec3 offset_m{0.0};     //!< position of the head relative to the observer, in the level axes [m]
  double eye_distance_m = 0.0;  //!< distance between the eyes

  bool operator==(const ViewerHead&) const = default;
};

//! An output's requirements for its next frame.
struct OutputWish {
  //! Eyes whose views the output defines, at most two, the left one first. Empty: the player
  //! renders the eyes of the show's stereo settings, in the show's projection, as large as it can
  //! render in time.
  std::vector<OutputEye> eyes;
  //! Head of the viewer, if the output follows one.
  std::optional<ViewerHead> head;
  //! Size of a flat panel on which the captions are shown apart from the picture.
  std::optional<CaptionPanel> caption_panel;
  //! Width of an eye's picture below which its quality is not reduced to save time [px].
  int smallest_px = 192;
  //! Show time of the frame [s]. Absent: the player's, when the frame is seen.
  std::optional<double> show_time_s;
  //! Stops of the frame before, from which automatic exposure continues. Absent: those of the last
  //! frame that was rendered.
  std::optional<double> stops_before;
  //! Angle of the output's pixels [rad] if it draws the stars itself (Picture::stars); 0: stars are
  //! part of the pictures.
  double star_pixel = 0.0;
  //! Time between frames of the output, in which a GPU shall render the picture of a moving camera
  //! [s]: its size is reduced for that, to at least `smallest_px`. 0: GPUs render the whole size.
  double frame_s = 0.0;
  //! Time from now until the frame is displayed [s]. If the show plays, it is rendered for that
  //! time.
  double display_delay_s = 0.0;
  //! Size of the window over which captions are composited. Absent: captions are composited over
  //! the projectors' images if these are finer than the picture; otherwise they are drawn in the
  //! picture.
  std::optional<ImageSize> window;
  //! Width of a domemaster whose pixels are as small as the projectors' pixels [px]; 0: no
  //! projectors.
  int projectors_px = 0;
};

//! How the eyes' pictures fill a window: as one picture, each in a separate buffer, or in
//! alternating rows.
enum class EyesInWindow { as_one, in_buffers, in_rows };

//! A finished frame.
struct OutputFrame {
  Picture picture;  //!< the only picture, or the left eye's
  //! Picture of the right eye, if both eyes' pictures are shown whole.
  std::optional<Picture> right_eye;
  //! True: the left eye's picture is above the right eye's, instead of beside it.
  bool eyes_above = false;
  //! How a window shows the eyes. If this is not as_one, `picture` contains both eyes side by side.
  EyesInWindow eyes = EyesInWindow::as_one;
  EyeGrid eye_grid;  //!< arrangement of the eyes in the shown picture
  //! Captions over each eye's picture, at the window's resolution; may be empty.
  LaidCaptions captions;
  glm::dquat turn{1.0, 0.0, 0.0, 0.0};  //!< with a ViewerHead: its `turn` in the wish for this frame
  CameraPose observer{};                //!< with a ViewerHead: camera of the show or flight, without the head
  //! The pictures in GPU memory, which replace the pixels above; valid until the next wish().
  std::optional<DevicePicture> on_device;
};

//! Gets frames that it asks for.
class Output {
 public:
  Output() = default;
  virtual ~Output() = default;
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;

  //! Returns what to render next; called once per frame.
  [[nodiscard]] virtual OutputWish wish() = 0;
  //! Takes a frame, and may change or keep its pictures.
  virtual void take(OutputFrame& frame) = 0;
};

//! Shows the frames of a player, each until the next one. Displays without a window need not
//! override what only windows have.
class DisplayOutput : public Output {
 public:
  //! Sets the factor on the light of the frames, 0 to 1. Texts of set_text() are not dimmed.
  virtual void set_light(double light) = 0;
  //! Shows the last frame. Returns when the next one can be shown.
  virtual void show() = 0;

  //! Returns whether the output was closed, by its user or by close().
  [[nodiscard]] virtual bool closed() const = 0;
  virtual void close() = 0;

  //! Returns whether each eye can have a separate buffer (EyesInWindow::in_buffers).
  [[nodiscard]] virtual bool has_eye_buffers() const { return false; }
  //! Returns whether show() has to be called for every frame, because it waits for the display.
  [[nodiscard]] virtual bool sets_pace() const { return false; }
  //! Returns whether the audience sees a dome instead of the window. The picture then shows the
  //! head's view, the player does not change the eyes, and help is drawn as a caption in the
  //! picture.
  [[nodiscard]] virtual bool is_dome() const { return false; }

  //! Replaces warps, masks and colors of a dome's projectors, in the order of its setup.
  virtual void set_projectors(const std::vector<ProjectorPicture>& /*pictures*/) {}
  //! Shows a raster on each projector of a dome instead of the frames; empty: frames.
  virtual void set_rasters(const std::vector<Picture>& /*rasters*/) {}
  //! Sets the text over the image of each projector of a dome.
  virtual void set_projector_texts(const std::vector<std::string>& /*texts*/) {}
  //! Joins the swap group of a dome of several computers, or leaves it (GLX_NV_swap_group). Returns
  //! why that is not possible; empty if it was done or is not necessary.
  [[nodiscard]] virtual std::string join_swap_group(bool /*joined*/) { return {}; }

  //! Sets the settings of a headset, when a show begins and when it was read again.
  virtual void set_headset(const HeadsetSettings& /*settings*/) {}
  //! Turns the surroundings of a viewer whose head an output follows. `rate`: -1 to 1, positive to
  //! the right.
  virtual void turn_viewer(double /*rate*/) {}
  //! Returns false while nobody looks at the output: while a headset is not worn.
  [[nodiscard]] virtual bool attended() const { return true; }
  //! Returns the state of the device on which the output shows, for operators; empty for a window.
  [[nodiscard]] virtual std::string state_text() const { return {}; }

  //! Returns the input events since the last call; waits some milliseconds for them.
  [[nodiscard]] virtual std::vector<WindowEvent> events() { return {}; }
  //! Returns the controllers of a headset; nothing without one. Called once per frame.
  [[nodiscard]] virtual std::optional<HeadsetHands> hands() { return std::nullopt; }
  //! Lets the controllers of a headset vibrate. `strength`: 0 to 1.
  virtual void pulse(double /*seconds*/, double /*strength*/) {}
  //! Returns the size of the area in which the mouse moves [px]; 0 x 0 for outputs without a mouse.
  [[nodiscard]] virtual ImageSize size() const { return {0, 0}; }
  virtual void toggle_full_screen() {}
  virtual void set_title(const std::string& /*title*/) {}
  //! Sets the text that is shown over the picture at a position; empty: none. PanelPosition::middle
  //! is for help: a list whose cells are separated by tabs. While it is shown, other texts and
  //! captions are hidden.
  virtual void set_text(PanelPosition /*place*/, const std::string& /*text*/) {}
  //! Writes what is currently shown to a PNG file.
  virtual void save_screenshot(const std::string& /*file*/) {}
};

}  // namespace ergodome
