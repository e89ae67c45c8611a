#pragma once

#include "kernels/flat_eyes/flat_disk.h"
#include "kernels/flat_eyes/flat_shells.h"
#include "kernels/flat_eyes/grid_sheets.h"
#include "kernels/near_field/pixel_samples.h"
#include "kernels/trace/pixel_geometry.h"

namespace ergodome::inline ERGO_TARGET {

//! What a register of pixels does, whatever it draws by: Derived has look_near(line, search, pixel, lanes, seen), which tells the lanes that hold more
//! than their middle does.
template <class T, class Derived>
struct FlatEyePixels {
  using D = Dual<T>;
  using S = ScalarOf<T>;
  using Mask = MaskOf<T>;

  const FlatEyeBatch& batch;
  const Derived& derived;

  //! Draws the pixels index * lanes, index * lanes + 1, ... of the block.
  ERGO_HD void draw(int index) const {
    const PixelBatch& pixels = batch.near_field.pixels;
    const int first = index * RealTraits<T>::lane_count;
    T x_px;
    T y_px;
    pixel_middles(pixels, first, x_px, y_px);
    const T inside = image_coverage(pixels.projection, x_px, y_px);
    Mask fine = inside > T(S(0));
    SeenLanes<T> seen = look(x_px, y_px, S(1), fine);
    if (any(fine)) {
      average(x_px, y_px, fine, seen);
    }
    lay_over(seen, inside, first, pixel_count(pixels), batch.near_field.rgba);
  }

 private:
  //! The last step to a sheet is no longer, as it is seen [px].
  static constexpr S precision_px = S(0.1);

  //! Looks at many places within the pixels of the mask.
  ERGO_HD void average(const T& x_px, const T& y_px, const Mask& fine, SeenLanes<T>& seen) const {
    const T zero(S(0));
    SeenLanes<T> sum = {zero, zero, zero, zero};
    for (int i = 0; i < near_samples * near_samples; ++i) {
      const NearSample<S> at = near_sample<S>(i);
      Mask wanted = fine;
      sum = sum + look(x_px + at.along, y_px + at.down, at.width, wanted);
    }
    take_mean(fine, sum, seen);
  }

  //! What is seen at places of the image, by pixels of a part of the image's own. `lanes` says which to look at, and then where images may
  //! be finer than that.
  ERGO_HD SeenLanes<T> look(const T& x_px, const T& y_px, S pixel, Mask& lanes) const {
    const EyeLine<T> line = {observed_direction(batch.near_field.pixels, x_px, y_px), batch.eye};
    SeenLanes<T> seen = nothing_seen<T>();
    const SheetSearch<S> search = search_for(line);
    const Mask wanted = lanes & may_see(line, search.most_w);
    lanes = lanes & !lanes;
    if (any(wanted)) {
      lanes = derived.look_near(line, search, pixel, wanted, seen);
    }
    return seen;
  }

  ERGO_HD SheetSearch<S> search_for(const EyeLine<T>& line) const {
    const Vector3<S>& eye = batch.eye;
    const S offset = sqrt(eye.x * eye.x + eye.y * eye.y + eye.z * eye.z);
    const auto square = [&line](T D::*part) {
      const S x = lane(line.m.x.*part, 0);
      const S y = lane(line.m.y.*part, 0);
      const S z = lane(line.m.z.*part, 0);
      return x * x + y * y + z * z;
    };
    const S pixel = sqrt(maximum(square(&D::along_x), square(&D::along_y)));
    return {batch.most_w, precision_px * pixel / offset};
  }

  //! Lanes that may see anything: of any place on their lines. A line that spans a small angle leaves what is large on one of its ends' sides.
  ERGO_HD Mask may_see(const EyeLine<T>& line, S most_w) const {
    const CameraStationOf<S>& camera = batch.near_field.pixels.camera;
    constexpr S small_square = S(0.01);
    const Vector3<S>& eye = batch.eye;
    const int places = most_w * most_w * dot(eye, eye) < small_square ? 1 : 5;
    const Vector3<T> m = {line.m.x.value, line.m.y.value, line.m.z.value};
    Mask may = m.x < m.x;
    for (int i = 0; i <= places; ++i) {
      const S w = most_w * static_cast<S>(i) / static_cast<S>(places);
      const Vector3<T> v = {m.x + w * eye.x, m.y + w * eye.y, m.z + w * eye.z};
      const T inverse = S(1) / sqrt(dot(v, v));
      may = may | may_reach(camera.spin, start_near_ray(camera, inverse * v), farthest_r());
    }
    return may;
  }

  //! The radius within which everything is [M].
  [[nodiscard]] ERGO_HD S farthest_r() const {
    const NearFieldBatch& scene = batch.near_field;
    const S disk = scene.drawing == DiskDrawing::none ? S(0) : scene.disk.outer_r;
    return scene.shells.count > 0 ? maximum(disk, S(1) / scene.shells.u[0]) : disk;
  }
};

//! Draws disk and shells as one eye of the stereo model `flat` sees them; an index stands for a register of pixels. Edges, and how finely a pixel is
//! looked at, are as in DrawNearField.
template <class T>
struct DrawFlatEyes {
  using S = ScalarOf<T>;
  using Mask = MaskOf<T>;

  FlatEyeBatch batch;

  ERGO_HD void operator()(int index) const { FlatEyePixels<T, DrawFlatEyes>{batch, *this}.draw(index); }

  ERGO_HD Mask look_near(const EyeLine<T>& line, const SheetSearch<S>& search, S pixel, const Mask& wanted,
                         SeenLanes<T>& seen) const {
    RaySheets<T> sheets(batch);
    FlatDisk<T, RaySheets<T>> disk(batch, sheets, line, search, pixel);
    const bool drawn = batch.near_field.drawing != DiskDrawing::none;
    if (drawn) {
      disk.meet(wanted);
    }
    int next[RealTraits<T>::lane_count] = {};
    const auto before = [&](int i, S minus_nearness) {
      if (drawn) {
        disk.compose_before(-minus_nearness, i, next[i], seen);
      }
    };
    Mask fine = wanted & !wanted;
    if (batch.near_field.shells.count > 0) {
      using Shells = FlatShells<T, decltype(before)>;
      fine = Shells(batch, line, search, pixel, before, seen).draw(wanted);
    }
    T fine_disk(S(0));
    for (int i = 0; i < RealTraits<T>::lane_count; ++i) {
      if (mask_lane(wanted, i) && drawn) {
        before(i, S(0));
        set_lane(fine_disk, i, disk.is_fine(i) ? S(1) : S(0));
      }
    }
    return wanted & (fine | (fine_disk > T(S(0))));
  }
};

//! The same for a disk that is read from a grid; lanes that the grid leaves to rays have them.
template <class T, bool WithPattern>
struct LookUpFlatEyes {
  using Mask = MaskOf<T>;

  FlatEyeLookUpBatch batch;

  ERGO_HD void operator()(int index) const { FlatEyePixels<T, LookUpFlatEyes>{batch.eye, *this}.draw(index); }

  ERGO_HD Mask look_near(const EyeLine<T>& line, const SheetSearch<float>& search, float pixel, const Mask& wanted,
                         SeenLanes<T>& seen) const {
    GridSheets<T, WithPattern> sheets(batch);
    FlatDisk<T, GridSheets<T, WithPattern>> disk(batch.eye, sheets, line, search, pixel);
    const Mask left = disk.meet(wanted);
    T fine(0.0F);
    compose(disk, wanted & !left, seen, fine);
    if (any(left)) {
      RaySheets<T> rays(batch.eye);
      FlatDisk<T, RaySheets<T>> traced(batch.eye, rays, line, search, pixel);
      traced.meet_near(disk, left);
      compose(traced, left, seen, fine);
    }
    return fine > T(0.0F);
  }

 private:
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

}  // namespace ergodome::inline ERGO_TARGET
