#include "render/passes/effects/bloom_across_seams.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "kernels/launch/parallel_for.h"
#include "kernels/launch/work_counter.h"
#include "kernels/projection/cube_cells.h"

namespace ergodome {

namespace {

//! Returns the width of the margin around a picture from which light is scattered into the picture
//! [px], at most `widest`.
int margin_px(const BloomSettings& settings, int widest) {
  return static_cast<int>(std::ceil(std::clamp(3.0 * settings.radius_px, 0.0, static_cast<double>(widest))));
}

Picture empty_picture(int width, int height) {
  Picture picture;
  picture.width = width;
  picture.height = height;
  picture.rgba.assign(4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0.0F);
  return picture;
}

float* pixel_at(Picture& picture, int x, int y) {
  return picture.rgba.data() + 4 * (static_cast<std::ptrdiff_t>(y) * picture.width + x);
}

const float* pixel_at(const Picture& picture, int x, int y) {
  return picture.rgba.data() + 4 * (static_cast<std::ptrdiff_t>(y) * picture.width + x);
}

void bloom_around(Picture& picture, const BloomSettings& settings) {
  const int margin = margin_px(settings, picture.width);
  Picture wide = empty_picture(picture.width + 2 * margin, picture.height);
  for (int y = 0; y < picture.height; ++y) {
    std::copy_n(pixel_at(picture, picture.width - margin, y), 4 * margin, pixel_at(wide, 0, y));
    std::copy_n(pixel_at(picture, 0, y), 4 * picture.width, pixel_at(wide, margin, y));
    std::copy_n(pixel_at(picture, 0, y), 4 * margin, pixel_at(wide, margin + picture.width, y));
  }
  add_bloom(wide, settings);
  for (int y = 0; y < picture.height; ++y) {
    std::copy_n(pixel_at(wide, margin, y), 4 * picture.width, pixel_at(picture, 0, y));
  }
}

//! Samples a picture bilinearly at a position within a cell.
void read_between(const Picture& picture, const PixelCell& cell, double x_px, double y_px, float (&rgba)[4]) {
  const double x = std::clamp(x_px - 0.5, static_cast<double>(cell.left_px), cell.left_px + cell.width_px - 1.0);
  const double y = std::clamp(y_px - 0.5, static_cast<double>(cell.top_px), cell.top_px + cell.height_px - 1.0);
  const int column = std::min(static_cast<int>(x), std::max(cell.left_px + cell.width_px - 2, cell.left_px));
  const int row = std::min(static_cast<int>(y), std::max(cell.top_px + cell.height_px - 2, cell.top_px));
  const auto across = static_cast<float>(x - column);
  const auto down = static_cast<float>(y - row);
  const int next_column = std::min(column + 1, cell.left_px + cell.width_px - 1);
  const int next_row = std::min(row + 1, cell.top_px + cell.height_px - 1);
  const float* corners[4] = {pixel_at(picture, column, row), pixel_at(picture, next_column, row),
                             pixel_at(picture, column, next_row), pixel_at(picture, next_column, next_row)};
  const float parts[4] = {(1.0F - across) * (1.0F - down), across * (1.0F - down), (1.0F - across) * down,
                          across * down};
  for (int c = 0; c < 4; ++c) {
    rgba[c] = 0.0F;
    for (int i = 0; i < 4; ++i) {
      rgba[c] += parts[i] > 0.0F ? parts[i] * corners[i][c] : 0.0F;
    }
  }
}

//! Returns a face with its surroundings, projected to the plane of the face.
Picture widened_face(const Picture& cube, const Projection& projection, CubeFace face, int margin) {
  const PixelCell cell = cube_face_cell(projection, face);
  const Projection alone = cube_face_of(projection, face);
  Picture wide = empty_picture(cell.width_px + 2 * margin, cell.height_px + 2 * margin);
  parallel_for(wide.height, 8, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      for (int x = 0; x < wide.width; ++x) {
        const Vector3<double> view = direction_from_pixel(alone, x - margin + 0.5, y - margin + 0.5);
        double x_px = 0.0;
        double y_px = 0.0;
        pixel_from_direction(projection, view, x_px, y_px);
        float rgba[4];
        read_between(cube, cube_face_cell(projection, face_of(view)), x_px, y_px, rgba);
        std::copy_n(rgba, 4, pixel_at(wide, x, y));
      }
    }
  });
  return wide;
}

void bloom_cube(Picture& picture, const Projection& projection, const BloomSettings& settings) {
  Picture bloomed = picture;
  for (int i = 0; i < cube_faces; ++i) {
    const auto face = static_cast<CubeFace>(i);
    const PixelCell cell = cube_face_cell(projection, face);
    const int margin = margin_px(settings, cell.width_px);
    Picture wide = widened_face(picture, projection, face, margin);
    // Copies the face's own pixels from the picture into `wide` unchanged, because widened_face()
    // has resampled them.
    for (int y = 0; y < cell.height_px; ++y) {
      std::copy_n(pixel_at(std::as_const(picture), cell.left_px, cell.top_px + y), 4 * cell.width_px,
                  pixel_at(wide, margin, margin + y));
    }
    add_bloom(wide, settings);
    for (int y = 0; y < cell.height_px; ++y) {
      std::copy_n(pixel_at(std::as_const(wide), margin, margin + y), 4 * cell.width_px,
                  pixel_at(bloomed, cell.left_px, cell.top_px + y));
    }
  }
  picture.rgba.swap(bloomed.rgba);
}

}  // namespace

void add_bloom(Picture& picture, const Projection& projection, const BloomSettings& settings) {
  static WorkCounter counter("add_bloom");
  const WorkScope work(counter, static_cast<long>(picture.width) * picture.height);
  if (projection.kind == ProjectionKind::cube && projection.cube.layout != CubeLayout::face) {
    bloom_cube(picture, projection, settings);
  } else if (wraps_around(projection)) {
    bloom_around(picture, settings);
  } else {
    add_bloom(picture, settings);
  }
}

}  // namespace ergodome
