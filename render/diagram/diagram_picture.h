#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "render/diagram/diagram_drawing.h"
#include "render/passes/objects/polygons/gl_thread.h"

namespace ergodome {

//! A picture as a display shows it: sRGB, three bytes a pixel, the top row first.
struct DiagramImage {
  int width_px;
  int height_px;
  std::vector<std::uint8_t> rgb;
};

//! Makes pictures of diagrams, with their words, through OpenGL without a display.
class DiagramPicture {
 public:
  //! Throws Error when no driver is there.
  DiagramPicture(int width_px, int height_px);
  ~DiagramPicture();
  DiagramPicture(const DiagramPicture&) = delete;
  DiagramPicture& operator=(const DiagramPicture&) = delete;

  //! A camera that has places in the picture above the legend.
  [[nodiscard]] OutsideCamera camera_for(const OutsideDirection& direction, const std::vector<Vector3<double>>& places,
                                         std::size_t legend_lines) const;

  DiagramImage draw(const DiagramScene& scene, const OutsideCamera& camera);

 private:
  int width_px_;
  int height_px_;
  GlThread gl_;
  std::unique_ptr<DiagramDrawing> drawing_;  //!< made and let go on that thread
};

}  // namespace ergodome
