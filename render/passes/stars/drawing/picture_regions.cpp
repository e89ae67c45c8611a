#include "render/passes/stars/drawing/picture_regions.h"

namespace ergodome {

std::vector<PictureRegion> picture_regions(const Projection& projection) {
  if (projection.kind != ProjectionKind::cube || projection.cube.layout == CubeLayout::face) {
    return {{projection, {0, 0, projection.width_px, projection.height_px}}};
  }
  std::vector<PictureRegion> regions;
  for (int i = 0; i < cube_faces; ++i) {
    const auto face = static_cast<CubeFace>(i);
    regions.push_back({cube_face_of(projection, face), cube_face_cell(projection, face)});
  }
  return regions;
}

}  // namespace ergodome
