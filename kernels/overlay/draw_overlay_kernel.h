#pragma once

#include "kernels/core/lanes.h"
#include "kernels/overlay/draw_overlay.h"

namespace ergodome::inline ERGO_TARGET {

//! Draws an overlay. Index i covers pixels i * lanes to (i + 1) * lanes - 1 of the tiles, each tile
//! row by row.
template <class T>
struct DrawOverlay {
  OverlayBatch batch;

  ERGO_HD void operator()(int index) const {
    constexpr int lanes = RealTraits<T>::lane_count;
    const int first = index * lanes;
    const int tile = batch.tiles[first / (overlay_tile_px * overlay_tile_px)];
    const int within = first % (overlay_tile_px * overlay_tile_px);
    const int x = tile % batch.tile_columns * overlay_tile_px + within % overlay_tile_px;
    const int y = tile / batch.tile_columns * overlay_tile_px + within / overlay_tile_px;
    if (x >= batch.projection.width_px || y >= batch.projection.height_px) {
      return;
    }
    const T x_px = lane_numbers<T>() + T(static_cast<float>(x) + 0.5F);
    const T y_px(static_cast<float>(y) + 0.5F);
    using D = Dual<T>;
    const T one(1.0F);
    const T zero(0.0F);
    const Vector3<D> view = direction_from_pixel(batch.projection, D(x_px, one, zero), D(y_px, zero, one));
    const Vector3<float>& axis = batch.surface.bound_axis;
    const T ahead = view.x.value * T(axis.x) + view.y.value * T(axis.y) + view.z.value * T(axis.z);
    const unsigned inside = mask_bits(ahead > T(batch.surface.bound_cosine));
    if (inside == 0U) {
      return;
    }
    D s;
    D t;
    project_to_surface(batch.surface, view, s, t);
    const T covered = image_coverage(batch.projection, x_px, y_px);
    for (int i = 0; i < lanes && x + i < batch.projection.width_px; ++i) {
      if (((inside >> static_cast<unsigned>(i)) & 1U) != 0U && lane(covered, i) > 0.0F) {
        const OverlayFootprint footprint = {lane(s.value, i),   lane(t.value, i),   lane(s.along_x, i),
                                            lane(s.along_y, i), lane(t.along_x, i), lane(t.along_y, i)};
        cover(batch.rgba + 4 * (static_cast<long>(y) * batch.projection.width_px + x + i), footprint, lane(covered, i));
      }
    }
  }

 private:
  //! Returns the fraction of a pixel in which a coordinate is between 0 and 1. `coordinate`: in the
  //! pixel's middle; `per_px`: its change per pixel.
  static ERGO_HD float part_between(float coordinate, float per_px) {
    const float px = 1.0F / maximum(per_px, 1e-9F);
    const float from = minimum(maximum(coordinate * px + 0.5F, 0.0F), 1.0F);
    const float to = minimum(maximum((1.0F - coordinate) * px + 0.5F, 0.0F), 1.0F);
    return maximum(from + to - 1.0F, 0.0F);
  }

  //! Returns the fraction of a pixel that the surface covers. A fisheye's circle covers pixels on
  //! its rim completely, since the picture's own rim is softer.
  ERGO_HD float surface_part(const OverlayFootprint& f) const {
    if (batch.surface.shape == OverlayShape::fisheye) {
      const float x = f.s - 0.5F;
      const float y = f.t - 0.5F;
      const float radius = sqrt(x * x + y * y);
      const float per_px = sqrt(0.5F * (f.s_along_x * f.s_along_x + f.s_along_y * f.s_along_y +
                                        f.t_along_x * f.t_along_x + f.t_along_y * f.t_along_y));
      return minimum(maximum((0.5F - radius) / maximum(per_px, 1e-9F) + 1.0F, 0.0F), 1.0F);
    }
    return part_between(f.s, sqrt(f.s_along_x * f.s_along_x + f.s_along_y * f.s_along_y)) *
           part_between(f.t, sqrt(f.t_along_x * f.t_along_x + f.t_along_y * f.t_along_y));
  }

  ERGO_HD void cover(float* pixel, const OverlayFootprint& footprint, float picture_part) const {
    const float part = batch.opacity * surface_part(footprint);
    if (!(part > 0.0F)) {
      return;
    }
    const Quad over = part * filtered_overlay(batch.texture, footprint);
    const float alpha = minimum(quad_part(over, 3), 1.0F);
    if (!(alpha > 0.0F) && !(quad_part(over, 0) + quad_part(over, 1) + quad_part(over, 2) > 0.0F)) {
      return;
    }
    for (int i = 0; i < 3; ++i) {
      const float light = batch.display_colours ? pixel[i] : toned(batch.tone, pixel[i]);
      const float shown = (1.0F - alpha) * ::fminf(::fmaxf(light, 0.0F), 1.0F) + picture_part * quad_part(over, i);
      pixel[i] = batch.display_colours ? shown : light_for_display(batch.tone, shown);
    }
    pixel[3] = (1.0F - alpha) * pixel[3] + picture_part * alpha;
  }
};

template <class T, class Action>
void dispatch(const OverlayBatch& batch, const Action& action) {
  action(DrawOverlay<T>{batch});
}

}  // namespace ergodome::inline ERGO_TARGET
