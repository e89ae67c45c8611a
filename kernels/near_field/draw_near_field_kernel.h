#pragma once

#include "kernels/disk/disk_sight.h"
#include "kernels/near_field/draw_near_field.h"
#include "kernels/near_field/layer_sight.h"
#include "kernels/near_rays/seen_light.h"
#include "kernels/shells/shell_sight.h"
#include "kernels/spacetime/trace/pixel_geometry.h"

namespace ergodome::inline ERGO_TARGET {

//! Draws disk and shells, with objects between them, over pixels. Index i covers pixels i * lanes
//! to (i + 1) * lanes - 1 of the block. Along a ray, nearer things hide farther ones, and all of
//! them hide the sky. Each variant computes only what its scene has.
template <class T, DiskDrawing Disk, bool Shells, bool Objects>
struct DrawNearField {
  using D = Dual<T>;
  using S = ScalarOf<T>;
  using Mask = MaskOf<T>;

  NearFieldBatch batch;

  ERGO_HD void operator()(int index) const {
    const PixelGroup at(batch, index);
    Mask fine = at.inside > T(S(0));
    if (leaves(at, fine)) {
      return;
    }
    SeenLanes<T> seen = seen_at(at.x_px, at.y_px, S(1), at.objects, fine);
    if (any(fine)) {
      average(at, fine, seen);
    }
    lay(at, seen);
  }

  //! First of two steps for GPUs, whose threads wait for one another: draws what is seen at the
  //! pixel's center. If the pixel contains finer images, draws nothing and returns true.
  ERGO_HD bool draw_middle(int index) const {
    const PixelGroup at(batch, index);
    Mask fine = at.inside > T(S(0));
    if (leaves(at, fine)) {
      return false;
    }
    const SeenLanes<T> seen = seen_at(at.x_px, at.y_px, S(1), at.objects, fine);
    if (!any(fine)) {
      lay(at, seen);
    }
    return any(fine);
  }

  //! Returns what one of a pixel's samples sees.
  [[nodiscard]] ERGO_HD SeenLanes<T> see_sample(int index, int sample) const {
    const PixelGroup at(batch, index);
    Mask wanted = at.inside > T(S(0));
    const NearSample<S> part = near_sample<S>(sample);
    return seen_at(at.x_px + part.along, at.y_px + part.down, part.width, at.objects, wanted);
  }

  //! Second step: draws the mean of the samples over the pixel.
  ERGO_HD void lay_mean(int index, const SeenLanes<T>& sum) const {
    const PixelGroup at(batch, index);
    SeenLanes<T> mean = sum;
    take_mean(at.inside > T(S(0)), sum, mean);
    lay(at, mean);
  }

 private:
  //! The register of pixels that one index draws.
  struct PixelGroup {
    int first;
    T x_px;
    T y_px;
    T inside;
    LayerSight<T, Objects> objects;

    ERGO_HD PixelGroup(const NearFieldBatch& batch, int index)
        : first(index * RealTraits<T>::lane_count), objects(batch.objects, first, pixel_count(batch.pixels)) {
      pixel_middles(batch.pixels, first, x_px, y_px);
      inside = image_coverage(batch.pixels.projection, x_px, y_px);
    }
  };

  //! If only pixels with objects are drawn (`objects_alone`), reduces `wanted` to their lanes, and
  //! returns whether none are left. Otherwise returns false.
  ERGO_HD bool leaves(const PixelGroup& at, Mask& wanted) const {
    if constexpr (Objects) {
      if (batch.objects_alone) {
        wanted = wanted & at.objects.waiting();
        return !any(wanted);
      }
    }
    return false;
  }

  ERGO_HD void lay(const PixelGroup& at, const SeenLanes<T>& seen) const {
    lay_over(seen, at.inside, at.first, pixel_count(batch.pixels), batch.rgba);
  }

  //! Replaces what the pixels of the mask see by the mean of near_samples² samples in each.
  ERGO_HD void average(const PixelGroup& group, const Mask& fine, SeenLanes<T>& seen) const {
    const T zero(S(0));
    SeenLanes<T> sum = {zero, zero, zero, zero};
    for (int i = 0; i < near_samples * near_samples; ++i) {
      const NearSample<S> at = near_sample<S>(i);
      Mask wanted = fine;
      sum = sum + seen_at(group.x_px + at.along, group.y_px + at.down, at.width, group.objects, wanted);
    }
    take_mean(fine, sum, seen);
  }

  //! Returns what is seen at positions of the image. `pixel`: width of a sample, as a fraction of a
  //! pixel. `lanes`: lanes to evaluate; afterwards, those where images may be finer than the
  //! sample.
  ERGO_HD SeenLanes<T> seen_at(const T& x_px, const T& y_px, S pixel, LayerSight<T, Objects> objects,
                               Mask& lanes) const {
    const PixelBatch& pixels = batch.pixels;
    const NearRay<D> ray = start_near_ray(pixels.camera, batch.omni, observed_direction(pixels, x_px, y_px));
    SeenLanes<T> seen = nothing_seen<T>();
    const Mask wanted = lanes & may_see(ray);
    Mask fine = lanes & !lanes;
    if (any(wanted)) {
      fine = draw_near(ray, pixel, wanted, objects, seen);
    }
    if constexpr (Objects) {
      const Mask waiting = lanes & objects.waiting();
      for (int i = 0; i < RealTraits<T>::lane_count; ++i) {
        if (mask_lane(waiting, i)) {
          objects.until(
              i, std::numeric_limits<S>::infinity(), [](int, S) {}, seen);
        }
      }
    }
    lanes = fine;
    return seen;
  }

  //! Evaluates lanes that may see disk or shells. Returns those where images may be finer than the
  //! sample.
  ERGO_HD Mask draw_near(const NearRay<D>& ray, S pixel, const Mask& wanted, LayerSight<T, Objects>& objects,
                         SeenLanes<T>& seen) const {
    const PixelBatch& pixels = batch.pixels;
    const NearLimits<S> limits = {static_cast<S>(pixels.settings.tolerance), pixels.settings.step_limit};
    if constexpr (Disk == DiskDrawing::none) {
      const auto before = [&](int i, S time) {
        objects.until(
            i, time, [](int, S) {}, seen);
      };
      return wanted & draw_shells(ray, limits, pixel, wanted, before, seen);
    } else {
      DiskSight<T, Disk == DiskDrawing::pattern> disk(pixels.camera, batch.disk, limits, ray, pixel);
      disk.trace(wanted);
      int next[RealTraits<T>::lane_count] = {};
      const auto disk_until = [&](int i, S time) {
        for (; disk.time(next[i], i) < time; ++next[i]) {
          disk.compose(next[i], i, seen);
        }
      };
      const auto before = [&](int i, S time) {
        objects.until(i, time, disk_until, seen);
        disk_until(i, time);
      };
      Mask fine = wanted & !wanted;
      if constexpr (Shells) {
        fine = draw_shells(ray, limits, pixel, wanted, before, seen);
      }
      T fine_disk(S(0));
      for (int i = 0; i < RealTraits<T>::lane_count; ++i) {
        if (mask_lane(wanted, i)) {
          before(i, std::numeric_limits<S>::max());
          set_lane(fine_disk, i, disk.is_fine(i) ? S(1) : S(0));
        }
      }
      return wanted & (fine | (fine_disk > T(S(0))));
    }
  }

  //! Adds the shells. Calls before(lane, time) ahead of each crossing, to add what is nearer.
  //! Returns the lanes where images may be finer than the sample.
  template <class Before>
  ERGO_HD Mask draw_shells(const NearRay<D>& ray, const NearLimits<S>& limits, S pixel, const Mask& wanted,
                           const Before& before, SeenLanes<T>& seen) const {
    const ShellTable& shells = batch.shells;
    ShellSight<T, Before> sight(batch.pixels.camera, shells, ray, pixel, before, seen);
    const Mask reached = wanted & may_reach(batch.pixels.camera.spin, ray, shells.appearances[0].r);
    trace_shells<near_order, NearParts::azimuth>(batch.pixels.camera.spin, ray, {shells.u, shells.count},
                                                 {limits.tolerance, limits.step_limit}, reached, sight);
    return sight.fine();
  }

  //! Returns the lanes that may see disk or shells.
  ERGO_HD Mask may_see(const NearRay<D>& ray) const {
    const S spin = batch.pixels.camera.spin;
    S r = S(0);
    if constexpr (Disk != DiskDrawing::none) {
      r = batch.disk.outer_r;
    }
    if constexpr (Shells) {
      r = maximum(r, batch.shells.appearances[0].r);
    }
    return may_reach(spin, ray, r);
  }
};

template <class T, class Action>
void dispatch(const NearFieldBatch& batch, const Action& action) {
  dispatch_near_field<DrawNearField, T>(batch, action);
}

}  // namespace ergodome::inline ERGO_TARGET
