#pragma once

#include "kernels/disk/disk_chart.h"
#include "kernels/disk/disk_sight.h"
#include "kernels/disk/layer_light.h"
#include "kernels/near_field/layer_sight.h"
#include "kernels/near_field/look_up_disk.h"
#include "kernels/near_rays/seen_light.h"
#include "kernels/spacetime/trace/pixel_geometry.h"

namespace ergodome::inline ERGO_TARGET {

//! Draws the disk over pixels from a grid. Index i covers pixels i * lanes to (i + 1) * lanes - 1
//! of the block. Crossings, edges and fine images are treated as in DrawNearField. Rays are traced
//! where the grid has no accurate leaf.
template <class T, bool WithPattern>
struct LookUpDisk {
  using D = Dual<T>;
  using Mask = MaskOf<T>;

  DiskLookUpBatch batch;

  ERGO_HD void operator()(int index) const {
    const PixelBatch& pixels = batch.near_field.pixels;
    const int first = index * RealTraits<T>::lane_count;
    T x_px;
    T y_px;
    pixel_middles(pixels, first, x_px, y_px);
    const T inside = image_coverage(pixels.projection, x_px, y_px);
    Mask fine = inside > T(0.0F);
    if (batch.near_field.objects.rgba != nullptr) {
      fine = fine & !LayerSight<T, true>(batch.near_field.objects, first, pixel_count(pixels)).waiting();
    }
    SeenLanes<T> seen = seen_at(x_px, y_px, 1.0F, fine);
    if (any(fine)) {
      average(x_px, y_px, fine, seen);
    }
    lay_over(seen, inside, first, pixel_count(pixels), batch.near_field.rgba);
  }

 private:
  //! Replaces what the pixels of the mask see by the mean of near_samples² samples in each.
  ERGO_HD void average(const T& x_px, const T& y_px, const Mask& fine, SeenLanes<T>& seen) const {
    const T zero(0.0F);
    SeenLanes<T> sum = {zero, zero, zero, zero};
    for (int i = 0; i < near_samples * near_samples; ++i) {
      const NearSample<float> at = near_sample<float>(i);
      Mask wanted = fine;
      sum = sum + seen_at(x_px + at.along, y_px + at.down, at.width, wanted);
    }
    take_mean(fine, sum, seen);
  }

  //! Returns what is seen at positions of the image. `pixel`: width of a sample, as a fraction of a
  //! pixel. `lanes`: lanes to evaluate; afterwards, those where images may be finer than the
  //! sample.
  ERGO_HD SeenLanes<T> seen_at(const T& x_px, const T& y_px, float pixel, Mask& lanes) const {
    const PixelBatch& pixels = batch.near_field.pixels;
    const Vector3<D> n = observed_direction(pixels, x_px, y_px);
    SeenLanes<T> seen = nothing_seen<T>();
    const NearRay<T> ray = start_near_ray(pixels.camera, Vector3<T>{n.x.value, n.y.value, n.z.value});
    const Mask wanted = lanes & may_reach(pixels.camera.spin, ray, batch.near_field.disk.outer_r);
    lanes = lanes & !lanes;
    if (!any(wanted)) {
      return seen;
    }
    const DiskPosition<T> position = disk_position(batch.grid.cells.chart.edge, rain_direction(batch.aberration, n));
    T fine(0.0F);
    T traced(0.0F);
    Leaf leaf{};
    for (int i = 0; i < RealTraits<T>::lane_count; ++i) {
      if (!mask_lane(wanted, i)) {
        continue;
      }
      const DiskLanePosition at = disk_lane_position(batch.grid.cells, position, i);
      if (!holds(leaf, at.gamma_turns, at.s)) {
        leaf = find_leaf(batch.grid.cells, at.gamma_turns, at.s);
      }
      const unsigned orders = batch.grid.orders[leaf.number];
      if (orders != 0 && leaf.flagged) {
        set_lane(traced, i, 1.0F);
      } else if (orders != 0) {
        set_lane(fine, i, read(leaf, at, orders, {pixel, i}, ray, seen) ? 1.0F : 0.0F);
      }
    }
    Mask finer = fine > T(0.0F);
    const Mask left = traced > T(0.0F);
    if (any(left)) {
      finer = finer | trace(n, pixel, left, seen);
    }
    lanes = finer;
    return seen;
  }

  //! A sample: its width as a fraction of a pixel's width, and its lane.
  struct Sample {
    float pixel;
    int lane;
  };

  //! Adds what a lane sees according to a leaf. Returns whether images may be finer than the
  //! sample.
  ERGO_HD bool read(const Leaf& leaf, const DiskLanePosition& at, unsigned orders, const Sample& seen_at,
                    const NearRay<T>& ray, SeenLanes<T>& seen) const {
    const LeafPosition within = position_in(leaf, at.gamma_turns, at.s);
    const int* const corners = batch.grid.cells.leaves + 4 * leaf.number;
    const auto patch = [&](int set) {
      return patch_value(batch.grid.nodes[set], corners, within.u, within.v, leaf.width_turns, leaf.height);
    };
    PatchValue value{};
    if constexpr (!WithPattern) {
      value = patch(0);
    }
    bool fine = false;
    for (int order = 0; order < layer_orders; ++order) {
      if ((orders & (1U << static_cast<unsigned>(order))) == 0U) {
        continue;
      }
      if constexpr (WithPattern) {
        value = patch(order);
      }
      const int part = WithPattern ? 0 : order;
      const float along_gamma = quad_part(value.along_gamma, part);
      const float along_s = quad_part(value.along_s, part);
      const float x = at.along_x(along_gamma, along_s);
      const float y = at.along_y(along_gamma, along_s);
      const float change = ::sqrtf(x * x + y * y);
      fine = fine || holds_finer(batch.near_field.disk, change);
      compose(quad_part(value.sky, part), seen_at.pixel * change, value, seen_at.lane, ray, seen);
    }
    return fine;
  }

  //! Composites the disk's light at a crossing behind everything that lane `i` has seen so far.
  ERGO_HD void compose(float u, float width, const PatchValue& value, int i, const NearRay<T>& ray,
                       SeenLanes<T>& seen) const {
    SeenLayer layer = {u, width, 1.0F, 0.0F, 0.0F, false};
    if constexpr (WithPattern) {
      layer.cosine = quad_part(value.sky, 1);
      layer.sine = quad_part(value.sky, 2);
      layer.delay = quad_part(value.sky, 3);
    }
    put_layer_behind<WithPattern>(batch.near_field.pixels.camera, batch.near_field.disk, layer,
                                  photon_constants(ray, i), i, seen);
  }

  //! Traces rays for the lanes of a mask. Returns the lanes where images may be finer than the
  //! sample.
  ERGO_HD Mask trace(const Vector3<D>& n, float pixel, const Mask& wanted, SeenLanes<T>& seen) const {
    const PixelBatch& pixels = batch.near_field.pixels;
    const NearRay<D> ray = start_near_ray(pixels.camera, n);
    const NearLimits<float> limits = {static_cast<float>(pixels.settings.tolerance), pixels.settings.step_limit};
    DiskSight<T, WithPattern> disk(pixels.camera, batch.near_field.disk, limits, ray, pixel);
    disk.trace(wanted);
    T fine(0.0F);
    for (int i = 0; i < RealTraits<T>::lane_count; ++i) {
      if (!mask_lane(wanted, i)) {
        continue;
      }
      for (int order = 0; disk.time(order, i) < std::numeric_limits<float>::max(); ++order) {
        disk.compose(order, i, seen);
      }
      set_lane(fine, i, disk.is_fine(i) ? 1.0F : 0.0F);
    }
    return fine > T(0.0F);
  }
};

template <class T, class Action>
void dispatch(const DiskLookUpBatch& batch, const Action& action) {
  if (batch.near_field.drawing == DiskDrawing::pattern) {
    action(LookUpDisk<T, true>{batch});
  } else {
    action(LookUpDisk<T, false>{batch});
  }
}

}  // namespace ergodome::inline ERGO_TARGET
