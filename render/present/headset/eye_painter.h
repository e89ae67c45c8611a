#pragma once

#include <array>
#include <glm/gtc/quaternion.hpp>
#include <memory>
#include <string>

#include "render/passes/overlay/caption_layer.h"
#include "render/present/headset/headset_session.h"
#include "render/present/headset/panorama.h"

// Draws what an eye in a headset sees: the lensed sky, and around the viewer a rest frame and
// panels with text.

namespace ergodome {

//! How the surroundings of the viewer look in a frame.
struct HeadsetScene {
  glm::dquat level_from_room{1.0, 0.0, 0.0, 0.0};  //!< rotates the room's axes into the observer's level axes
  double light = 1.0;                              //!< factor on the light of the sky, 0 to 1
  double exposure_stops = 0.0;                     //!< stops in addition to the panorama's tone
  bool rest_frame = true;                          //!< draws a ring and a floor grid that stand still in the room
  double floor_m = 0.0;                            //!< height of the floor in the room
  glm::dvec3 middle_m{0.0};                        //!< middle of the rest frame and the panels on the floor
  double facing_rad = 0.0;            //!< direction of the panels from there, to the left of the room's front
  double vignette = 0.0;              //!< darkness outside the clear view, 0 to 1
  double clear_half_angle_rad = 1.0;  //!< half angle of the clear view
  bool panels = true;                 //!< draws captions and text
};

//! Draws eyes' views with OpenGL.
class EyePainter {
 public:
  //! Uses the current OpenGL 4.5 context. Throws Error if the driver rejects the shader.
  EyePainter();
  ~EyePainter();
  EyePainter(const EyePainter&) = delete;
  EyePainter& operator=(const EyePainter&) = delete;

  //! Sets the captions of the show on their panel; none without a layer.
  void set_captions(const LaidCaptions& captions);
  //! Sets the text on the panel above the captions; empty: none. Cells separated by tabs form
  //! columns.
  void set_text(const std::string& text);

  //! Draws an eye's view into the bound framebuffer. Values are stored as sRGB if `encoded`,
  //! otherwise as linear light. An empty panorama is black.
  void draw(const Panorama& panorama, int eye, const HeadsetEye& view, const HeadsetScene& scene, ImageSize size,
            bool encoded) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

//! Size of the panel for captions, in tangents of the view from its middle, and of its texture.
inline constexpr double caption_panel_half_width = 0.62;
inline constexpr double caption_panel_aspect = 2.2;
inline constexpr int caption_panel_px = 1024;

}  // namespace ergodome
