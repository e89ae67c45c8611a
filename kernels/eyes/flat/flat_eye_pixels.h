#pragma once

#include "kernels/eyes/flat/draw_flat_eyes.h"
#include "kernels/eyes/flat/eye_line.h"
#include "kernels/near_field/layer_sight.h"
#include "kernels/near_rays/near_pixels.h"
#include "kernels/near_rays/seen_light.h"
#include "kernels/spacetime/trace/pixel_geometry.h"

namespace ergodome::inline ERGO_TARGET {

//! Draws a register of pixels, for different sources of the near field. `Derived` provides:
//! draw_near(line, search, pixel, lanes, objects, seen), which returns the lanes with detail finer
//! than a pixel; average(pixels, place, lanes, sum), which sums all samples of these lanes; and
//! leaves_objects, whether pixels that show objects are skipped.
template <class T, class Derived>
struct FlatEyePixels {
  using D = Dual<T>;
  using S = ScalarOf<T>;
  using Mask = MaskOf<T>;

  using Objects = LayerSight<T, true>;

  const FlatEyeBatch& batch;
  const Derived& derived;

  //! The register of pixels that one index draws.
  struct PixelGroup {
    int first;
    T x_px;
    T y_px;
    T inside;
    Objects objects;

    ERGO_HD PixelGroup(const FlatEyeBatch& batch, int index)
        : first(index * RealTraits<T>::lane_count),
          objects(batch.near_field.objects, first, pixel_count(batch.near_field.pixels)) {
      const PixelBatch& pixels = batch.near_field.pixels;
      pixel_middles(pixels, first, x_px, y_px);
      inside = image_coverage(pixels.projection, x_px, y_px);
    }
  };

  //! Draws the pixels index * lanes, index * lanes + 1, ... of the block.
  ERGO_HD void draw(int index) const {
    const PixelGroup at(batch, index);
    Mask fine = drawn(at);
    if (!any(fine)) {
      return;
    }
    SeenLanes<T> seen = seen_at(at.x_px, at.y_px, S(1), at.objects, fine);
    if (any(fine)) {
      const T zero(S(0));
      SeenLanes<T> sum = {zero, zero, zero, zero};
      derived.average(*this, at, fine, sum);
      take_mean(fine, sum, seen);
    }
    lay(at, seen);
  }

  //! First of two steps, as in DrawNearField: draws what is seen at the pixels' centers. If a pixel
  //! contains finer detail, draws nothing and returns true.
  ERGO_HD bool draw_middle(int index) const {
    const PixelGroup at(batch, index);
    Mask fine = drawn(at);
    if (!any(fine)) {
      return false;
    }
    const SeenLanes<T> seen = seen_at(at.x_px, at.y_px, S(1), at.objects, fine);
    if (!any(fine)) {
      lay(at, seen);
    }
    return any(fine);
  }

  [[nodiscard]] ERGO_HD SeenLanes<T> see_sample(int index, int sample) const {
    const PixelGroup at(batch, index);
    Mask wanted = drawn(at);
    const NearSample<S> part = near_sample<S>(sample);
    return seen_at(at.x_px + part.along, at.y_px + part.down, part.width, at.objects, wanted);
  }

  ERGO_HD void lay_mean(int index, const SeenLanes<T>& sum) const {
    const PixelGroup at(batch, index);
    SeenLanes<T> mean = sum;
    take_mean(drawn(at), sum, mean);
    lay(at, mean);
  }

  //! Returns what is seen at image positions, each the center of a square of side `pixel` (a
  //! fraction of a pixel). `lanes` selects the lanes, and receives those with finer detail. `more`
  //! is passed to draw_near().
  template <class... More>
  ERGO_HD SeenLanes<T> seen_at(const T& x_px, const T& y_px, S pixel, Objects objects, Mask& lanes,
                               More&... more) const {
    const EyeLine<T> line = line_at(x_px, y_px);
    SeenLanes<T> seen = nothing_seen<T>();
    const LayerSearch<S> search = search_for(line);
    const Mask wanted = lanes & may_see(line, search.max_w);
    Mask fine = lanes & !lanes;
    if (any(wanted)) {
      fine = derived.draw_near(line, search, pixel, wanted, objects, seen, more...);
    }
    const Mask waiting = lanes & objects.waiting();
    for (int i = 0; any(waiting) && i < RealTraits<T>::lane_count; ++i) {
      if (mask_lane(waiting, i)) {
        objects.until(
            i, std::numeric_limits<S>::infinity(), [](int, S) {}, seen);
      }
    }
    lanes = fine;
    return seen;
  }

  [[nodiscard]] ERGO_HD EyeLine<T> line_at(const T& x_px, const T& y_px) const {
    return {observed_direction(batch.near_field.pixels, x_px, y_px), batch.eye};
  }

  [[nodiscard]] ERGO_HD LayerSearch<S> search_for(const EyeLine<T>& line) const {
    const Vector3<S>& eye = batch.eye;
    const S offset = sqrt(eye.x * eye.x + eye.y * eye.y + eye.z * eye.z);
    const auto square = [&line](T D::*part) {
      const S x = lane(line.m.x.*part, 0);
      const S y = lane(line.m.y.*part, 0);
      const S z = lane(line.m.z.*part, 0);
      return x * x + y * y + z * z;
    };
    const S pixel = sqrt(maximum(square(&D::along_x), square(&D::along_y)));
    return {batch.max_w, precision_px * pixel / offset};
  }

 private:
  //! Returns the pixels to draw: those inside the image, either without the pixels that show
  //! objects (leaves_objects) or only these (objects_alone).
  [[nodiscard]] ERGO_HD Mask drawn(const PixelGroup& at) const {
    const Mask inside = at.inside > T(S(0));
    if constexpr (Derived::leaves_objects) {
      return inside & !at.objects.waiting();
    }
    return batch.near_field.objects_alone ? inside & at.objects.waiting() : inside;
  }

  ERGO_HD void lay(const PixelGroup& at, const SeenLanes<T>& seen) const {
    lay_over(seen, at.inside, at.first, pixel_count(batch.near_field.pixels), batch.near_field.rgba);
  }

  //! The search for a layer ends when its step is shorter than this in the image [px].
  static constexpr S precision_px = S(0.1);

  //! Returns the lanes that may see anything, from samples along their lines in steps that are
  //! small relative to the scene.
  ERGO_HD Mask may_see(const EyeLine<T>& line, S max_w) const {
    const CameraStationOf<S>& camera = batch.near_field.pixels.camera;
    constexpr S max_positions = S(32);
    const Vector3<S>& eye = batch.eye;
    const S span = max_w * sqrt(dot(eye, eye)) / (S(0.5) * farthest_r() * camera.u);
    const int positions = 1 + static_cast<int>(minimum(span, max_positions));
    const Vector3<T> m = {line.m.x.value, line.m.y.value, line.m.z.value};
    Mask may = m.x < m.x;
    for (int i = 0; i <= positions; ++i) {
      const S w = max_w * static_cast<S>(i) / static_cast<S>(positions);
      const Vector3<T> v = {m.x + w * eye.x, m.y + w * eye.y, m.z + w * eye.z};
      const T inverse = S(1) / sqrt(dot(v, v));
      may = may | may_reach(camera.spin, start_near_ray(camera, inverse * v), farthest_r());
    }
    return may;
  }

  //! Returns the radius that contains the whole scene [M].
  [[nodiscard]] ERGO_HD S farthest_r() const {
    const NearFieldBatch& scene = batch.near_field;
    const S disk = scene.drawing == DiskDrawing::none ? S(0) : scene.disk.outer_r;
    return scene.shells.count > 0 ? maximum(disk, S(1) / scene.shells.u[0]) : disk;
  }
};

}  // namespace ergodome::inline ERGO_TARGET
