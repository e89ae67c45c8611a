#pragma once

#include "kernels/eyes/flat/flat_disk.h"
#include "kernels/eyes/flat/flat_eye_pixels.h"
#include "kernels/eyes/flat/grid_layers.h"

// Draws the disk for one eye of the stereo model `flat` from a grid.
namespace ergodome::inline ERGO_TARGET {

//! Samples of a register's pixels for which the grid is inaccurate, so that rays are traced. All
//! are collected first, then traced together in full registers; only the last register may be
//! partly filled.
template <class T>
struct LeftSamples {
  static constexpr int maximum = RealTraits<T>::lane_count * near_samples * near_samples;

  struct Sample {
    float x_px;
    float y_px;
    //! First guess of the nearness of each order's layer, from the grid.
    float guess[crossing_orders];
    int lane;
  };

  Sample samples[maximum];
  int count = 0;
};

//! Draws a disk that is read from a grid as one eye of the stereo model `flat` sees it. Rays are
//! traced where the grid is inaccurate.
template <class T, bool WithPattern>
struct LookUpFlatEyes {
  using Mask = MaskOf<T>;
  using Grid = FlatDisk<T, GridLayers<T, WithPattern>>;
  using Traced = FlatDisk<T, RayLayers<T>>;

  FlatEyeLookUpBatch batch;

  using Pixels = FlatEyePixels<T, LookUpFlatEyes>;
  using Objects = typename Pixels::Objects;
  static constexpr bool leaves_objects = true;

  ERGO_HD void operator()(int index) const { Pixels{batch.eye, *this}.draw(index); }

  //! Sums all samples of the given lanes. In each sample, few lanes need rays because the grid is
  //! inaccurate, but over all samples there are many. So they are collected and traced together.
  ERGO_HD void average(const Pixels& pixels, const typename Pixels::PixelGroup& group, const Mask& lanes,
                       SeenLanes<T>& sum) const {
    LeftSamples<T> left;
    for (int i = 0; i < near_samples * near_samples; ++i) {
      const NearSample<float> at = near_sample<float>(i);
      const T x = group.x_px + at.along;
      const T y = group.y_px + at.down;
      Mask wanted = lanes;
      Waiting waiting = {left, x, y};
      sum = sum + pixels.seen_at(x, y, at.width, group.objects, wanted, waiting);
    }
    for (int first = 0; first < left.count; first += RealTraits<T>::lane_count) {
      trace(pixels, left, first, sum);
    }
  }

  ERGO_HD Mask draw_near(const EyeLine<T>& line, const LayerSearch<float>& search, float pixel, const Mask& wanted,
                         const Objects&, SeenLanes<T>& seen) const {
    GridLayers<T, WithPattern> layers(batch);
    Grid disk(batch.eye, layers, line, search, pixel);
    const Mask left = disk.meet(wanted);
    T fine(0.0F);
    compose(disk, wanted & !left, seen, fine);
    if (any(left)) {
      RayLayers<T> rays(batch.eye);
      Traced traced(batch.eye, rays, line, search, pixel);
      traced.meet_near(disk, left);
      compose(traced, left, seen, fine);
    }
    return fine > T(0.0F);
  }

  //! The collection of samples that rays must trace, and the positions of the current samples in
  //! the picture.
  struct Waiting {
    LeftSamples<T>& left;
    const T& x_px;
    const T& y_px;
  };

  //! Does the same as the draw_near() above, but collects the lanes for which the grid is
  //! inaccurate. Until they are traced, they count as opaque and black.
  ERGO_HD Mask draw_near(const EyeLine<T>& line, const LayerSearch<float>& search, float pixel, const Mask& wanted,
                         const Objects&, SeenLanes<T>& seen, Waiting& waiting) const {
    GridLayers<T, WithPattern> layers(batch);
    Grid disk(batch.eye, layers, line, search, pixel);
    const Mask left = disk.meet(wanted);
    T fine(0.0F);
    compose(disk, wanted & !left, seen, fine);
    for (int i = 0; any(left) && i < RealTraits<T>::lane_count; ++i) {
      if (mask_lane(left, i)) {
        auto& sample = waiting.left.samples[waiting.left.count++];
        sample.x_px = lane(waiting.x_px, i);
        sample.y_px = lane(waiting.y_px, i);
        sample.lane = i;
        for (int order = 0; order < crossing_orders; ++order) {
          sample.guess[order] = lane(disk.guess(order), i);
        }
        set_lane(seen.clear, i, 0.0F);
      }
    }
    return fine > T(0.0F);
  }

 private:
  //! Traces a register of collected samples, and adds the results to their lanes.
  ERGO_HD void trace(const Pixels& pixels, const LeftSamples<T>& left, int first, SeenLanes<T>& sum) const {
    constexpr int lanes = RealTraits<T>::lane_count;
    const auto sample = [&](int i) -> const auto& {
      return left.samples[first + i < left.count ? first + i : left.count - 1];
    };
    T x(0.0F);
    T y(0.0F);
    T wanted(0.0F);
    T guesses[crossing_orders] = {x, x, x};
    for (int i = 0; i < lanes; ++i) {
      set_lane(x, i, sample(i).x_px);
      set_lane(y, i, sample(i).y_px);
      set_lane(wanted, i, first + i < left.count ? 1.0F : 0.0F);
      for (int order = 0; order < crossing_orders; ++order) {
        set_lane(guesses[order], i, sample(i).guess[order]);
      }
    }
    const EyeLine<T> line = pixels.line_at(x, y);
    RayLayers<T> rays(batch.eye);
    Traced traced(batch.eye, rays, line, pixels.search_for(line), 1.0F / near_samples);
    traced.meet_near(guesses, wanted > T(0.0F));
    SeenLanes<T> seen = nothing_seen<T>();
    T fine(0.0F);
    compose(traced, wanted > T(0.0F), seen, fine);
    for (int i = 0; i < lanes && first + i < left.count; ++i) {
      const int to = sample(i).lane;
      const auto add = [i, to](T& total, const T& part) { set_lane(total, to, lane(total, to) + lane(part, i)); };
      add(sum.red, seen.red);
      add(sum.green, seen.green);
      add(sum.blue, seen.blue);
      add(sum.clear, seen.clear);
    }
  }

  template <class Disk>
  ERGO_HD static void compose(const Disk& disk, const Mask& lanes, SeenLanes<T>& seen, T& fine) {
    for (int i = 0; i < RealTraits<T>::lane_count; ++i) {
      if (mask_lane(lanes, i)) {
        int next = 0;
        disk.compose_before(0.0F, i, next, seen);
        set_lane(fine, i, disk.is_fine(i) ? 1.0F : 0.0F);
      }
    }
  }
};

template <class T, class Action>
void dispatch(const FlatEyeLookUpBatch& batch, const Action& action) {
  if (batch.eye.near_field.drawing == DiskDrawing::pattern) {
    action(LookUpFlatEyes<T, true>{batch});
  } else {
    action(LookUpFlatEyes<T, false>{batch});
  }
}

}  // namespace ergodome::inline ERGO_TARGET
