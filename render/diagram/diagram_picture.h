#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "render/diagram/diagram_drawing.h"
#include "render/opengl/gl_thread.h"

// Draws pictures of diagrams with their texts.

namespace ergodome {

//! A display-referred picture: sRGB, three bytes per pixel, top row first.
struct DiagramImage {
  int width_px;
  int height_px;
  std::vector<std::uint8_t> rgb;
};

//! Draws pictures of diagrams with their texts, through OpenGL without a display.
class DiagramPicture {
 public:
  //! Throws Error if there is no OpenGL driver.
  DiagramPicture(int width_px, int height_px);
  ~DiagramPicture();
  DiagramPicture(const DiagramPicture&) = delete;
  DiagramPicture& operator=(const DiagramPicture&) = delete;

  //! Returns a camera that shows all positions in the part of the picture above the legend. The
  //! legend counts as at most 60 % of the height.
  [[nodiscard]] OutsideCamera camera_for(const OutsideDirection& direction,
                                         const std::vector<Vector3<double>>& positions, std::size_t legend_lines) const;

  DiagramImage draw(const DiagramScene& scene, const OutsideCamera& camera);

 private:
  int width_px_;
  int height_px_;
  GlThread gl_;
  std::unique_ptr<DiagramDrawing> drawing_;  //!< created and destroyed on the thread of gl_
};

}  // namespace ergodome
