#pragma once

#include <memory>
#include <vector>

#include "render/diagram/diagram_scene.h"
#include "render/diagram/outside_camera.h"
#include "render/passes/objects/polygons/object_target.h"

namespace ergodome {

//! Draws a diagram's triangles and lines in the current OpenGL context.
class DiagramDrawing {
 public:
  //! Throws Error if the driver rejects the shaders.
  DiagramDrawing();
  ~DiagramDrawing();
  DiagramDrawing(const DiagramDrawing&) = delete;
  DiagramDrawing& operator=(const DiagramDrawing&) = delete;

  //! Draws a picture on a paper-colored background: linear light, three floats per pixel, top row
  //! first. Every pixel is the mean of sixteen samples.
  std::vector<float> draw(const DiagramScene& scene, const OutsideCamera& camera, int width_px, int height_px);

 private:
  struct Uploaded;
  struct Tile;

  [[nodiscard]] Uploaded upload(const DiagramScene& scene, const OutsideCamera& camera);
  void draw_tile(const Uploaded& uploaded, const OutsideCamera& camera, const Tile& tile) const;
  //! Composites the means of a tile's samples, bottom row first, over the paper-colored background
  //! of the picture.
  static void lay_on_paper(const std::vector<float>& rgba, const Tile& tile, std::vector<float>& picture);

  unsigned surface_program_ = 0;
  unsigned line_program_ = 0;
  unsigned surface_array_ = 0;
  unsigned line_array_ = 0;
  unsigned surface_buffer_ = 0;
  unsigned line_buffer_ = 0;
  std::unique_ptr<ObjectTarget> target_;
};

}  // namespace ergodome
