#include "render/picture/cube_pictures.h"

#include <algorithm>

#include "kernels/projection/cube_cells.h"

namespace ergodome {

std::string cube_face_name(CubeFace face) {
  constexpr const char* names[] = {"px", "nx", "py", "ny", "pz", "nz"};
  return names[static_cast<int>(face)];
}

namespace {

//! Copies a rectangle of a picture.
void copy_cell(const Picture& from, const PixelCell& cell, Picture& to, int left_px, int top_px) {
  const auto at = [](const Picture& picture, int x, int y) {
    return static_cast<std::ptrdiff_t>(4) * (static_cast<std::ptrdiff_t>(y) * picture.width + x);
  };
  for (int y = 0; y < cell.height_px; ++y) {
    std::copy_n(from.rgba.begin() + at(from, cell.left_px, cell.top_px + y), 4 * cell.width_px,
                to.rgba.begin() + at(to, left_px, top_px + y));
  }
}

}  // namespace

std::array<Picture, cube_faces> cube_face_pictures(const Picture& strips, const Projection& projection) {
  const int eyes_across = strips.width / projection.width_px;
  const int eyes_down = strips.height / projection.height_px;
  std::array<Picture, cube_faces> faces;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const PixelCell cell = cube_face_cell(projection, static_cast<CubeFace>(i));
    Picture& face = faces[i];
    face.width = eyes_across * cell.width_px;
    face.height = eyes_down * cell.height_px;
    face.lens = strips.lens;
    face.behind = strips.behind;
    face.unresolved_pixels = i == 0 ? strips.unresolved_pixels : 0;
    face.heat_range = strips.heat_range;
    face.tone = strips.tone;
    face.rgba.resize(4 * static_cast<std::size_t>(face.width) * static_cast<std::size_t>(face.height));
    for (int row = 0; row < eyes_down; ++row) {
      for (int column = 0; column < eyes_across; ++column) {
        const PixelCell of_eye = {cell.left_px + column * projection.width_px, cell.top_px + row * projection.height_px,
                                  cell.width_px, cell.height_px};
        copy_cell(strips, of_eye, face, column * cell.width_px, row * cell.height_px);
      }
    }
  }
  return faces;
}

}  // namespace ergodome
