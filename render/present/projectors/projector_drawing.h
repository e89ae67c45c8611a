#pragma once

#include <memory>

#include "calibration/projectors/projector_picture.h"
#include "render/present/caption_texture.h"
#include "render/present/display_light.h"

namespace ergodome {

//! Draws what one projector shows of a domemaster: the master's light through the warp, blended, lifted and encoded for the projector.
//! projector_light.h has the formula, in the order of its steps.
class ProjectorDrawing {
 public:
  //! Needs the OpenGL context current in which it will draw, and keeps to it. Throws Error when the driver refuses the shader.
  explicit ProjectorDrawing(const ProjectorPicture& picture);
  ~ProjectorDrawing();
  ProjectorDrawing(const ProjectorDrawing&) = delete;
  ProjectorDrawing& operator=(const ProjectorDrawing&) = delete;

  //! Takes over another warp, and corners that it is to be moved by.
  void set_warp(const WarpMesh& warp, const GridOffsets& grid);

  //! Takes over lift, gain and gamma of a picture; its masks stay as they were.
  void set_colour(const ProjectorPicture& picture);

  //! Draws into the bound framebuffer of the given size; black where the warp is not drawn, lifted as elsewhere.
  void draw(const DisplayLight& light, int framebuffer_width, int framebuffer_height);

  //! Draws captions over the picture that was drawn, at their own resolution. Pixels without captions stay as they are. `dimmed`: factor on the
  //! captions' light. `light`: of the picture below them.
  void draw_captions(const CaptionTexture& captions, float dimmed, const DisplayLight& light, int framebuffer_width,
                     int framebuffer_height);

 private:
  //! Draws the mesh from one of its indices on.
  void draw_mesh(unsigned program, int first_index);

  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace ergodome
