#include "render/passes/stars/drawing/picture_sheets.h"

namespace ergodome {

std::vector<PictureSheet> picture_sheets(const Projection& projection) {
  if (projection.kind != ProjectionKind::cube || projection.cube.layout == CubeLayout::face) {
    return {{projection, {0, 0, projection.width_px, projection.height_px}}};
  }
  std::vector<PictureSheet> sheets;
  for (int i = 0; i < cube_faces; ++i) {
    const auto face = static_cast<CubeFace>(i);
    sheets.push_back({cube_face_of(projection, face), cube_face_cell(projection, face)});
  }
  return sheets;
}

}  // namespace ergodome
