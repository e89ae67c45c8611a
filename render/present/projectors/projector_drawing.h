#pragma once

#include <memory>

#include "calibration/projectors/projector_picture.h"
#include "render/present/caption_texture.h"
#include "render/present/projectors/display_light.h"

namespace ergodome {

//! Draws one projector's view of a domemaster: the master's light through the warp, blended, lifted
//! and encoded for the projector. tests/render/present/projectors/projector_light.h has the
//! formula, in the order of its steps.
class ProjectorDrawing {
 public:
  //! Binds to the current OpenGL context. Throws Error if the driver rejects the shader.
  explicit ProjectorDrawing(const ProjectorPicture& picture);
  ~ProjectorDrawing();
  ProjectorDrawing(const ProjectorDrawing&) = delete;
  ProjectorDrawing& operator=(const ProjectorDrawing&) = delete;

  //! Replaces the warp, and the grid of offsets that moves the warp's nodes.
  void set_warp(const WarpMesh& warp, const GridOffsets& grid);

  //! Sets lift, gain and gamma to those of a picture; does not change the masks.
  void set_colour(const ProjectorPicture& picture);

  //! Draws into the bound framebuffer of the given size. Parts of the raster outside the warp get
  //! black plus the black-level lift.
  void draw(const DisplayLight& light, int framebuffer_width, int framebuffer_height);

  //! Draws captions over the picture, at their own resolution. Pixels without captions are not
  //! changed. `dimmed`: factor on the captions' light. `light`: light of the picture below the
  //! captions.
  void draw_captions(const CaptionTexture& captions, float dimmed, const DisplayLight& light, int framebuffer_width,
                     int framebuffer_height);

 private:
  //! Draws the triangles of the mesh, from an index on.
  void draw_mesh(unsigned program, int first_index);

  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace ergodome
