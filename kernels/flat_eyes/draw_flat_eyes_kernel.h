#pragma once

#include "kernels/flat_eyes/flat_disk.h"
#include "kernels/flat_eyes/flat_shells.h"
#include "kernels/flat_eyes/grid_sheets.h"
#include "kernels/near_field/pixel_samples.h"
#include "kernels/trace/pixel_geometry.h"

namespace ergodome::inline ERGO_TARGET {

//! Samples of a register's pixels that a grid leaves to rays: they are put off until there are as many as a register has lanes.
template <class T>
struct LeftSamples {
  static constexpr int most = RealTraits<T>::lane_count * near_samples * near_samples;

  struct Sample {
    float x_px;
    float y_px;
    float guess[crossing_orders];  //!< of the sheets' nearness
    int lane;
  };

  Sample samples[most];
  int count = 0;
};

//! What a register of pixels does, whatever it draws by: Derived has look_near(line, search, pixel, lanes, seen), which tells the lanes that hold more
//! than their middle does, and average(pixels, x_px, y_px, lanes), the sum of what all their samples see.
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
      const T zero(S(0));
      SeenLanes<T> sum = {zero, zero, zero, zero};
      derived.average(*this, x_px, y_px, fine, sum);
      take_mean(fine, sum, seen);
    }
    lay_over(seen, inside, first, pixel_count(pixels), batch.near_field.rgba);
  }

  //! What is seen at places of the image, by pixels of a part of the image's own. `lanes` says which to look at, and then where images may
  //! be finer than that. `more` are what look_near is to be told.
  template <class... More>
  ERGO_HD SeenLanes<T> look(const T& x_px, const T& y_px, S pixel, Mask& lanes, More&... more) const {
    const EyeLine<T> line = line_at(x_px, y_px);
    SeenLanes<T> seen = nothing_seen<T>();
    const SheetSearch<S> search = search_for(line);
    const Mask wanted = lanes & may_see(line, search.most_w);
    lanes = lanes & !lanes;
    if (any(wanted)) {
      lanes = derived.look_near(line, search, pixel, wanted, seen, more...);
    }
    return seen;
  }

  [[nodiscard]] ERGO_HD EyeLine<T> line_at(const T& x_px, const T& y_px) const {
    return {observed_direction(batch.near_field.pixels, x_px, y_px), batch.eye};
  }

  [[nodiscard]] ERGO_HD SheetSearch<S> search_for(const EyeLine<T>& line) const {
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

 private:
  //! The last step to a sheet is no longer, as it is seen [px].
  static constexpr S precision_px = S(0.1);

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

  using Pixels = FlatEyePixels<T, DrawFlatEyes>;

  ERGO_HD void operator()(int index) const { Pixels{batch, *this}.draw(index); }

  ERGO_HD void average(const Pixels& pixels, const T& x_px, const T& y_px, const Mask& lanes, SeenLanes<T>& sum) const {
    for (int i = 0; i < near_samples * near_samples; ++i) {
      const NearSample<S> at = near_sample<S>(i);
      Mask wanted = lanes;
      sum = sum + pixels.look(x_px + at.along, y_px + at.down, at.width, wanted);
    }
  }

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

//! The same for a disk that is read from a grid; what the grid leaves to rays has them.
template <class T, bool WithPattern>
struct LookUpFlatEyes {
  using Mask = MaskOf<T>;
  using Grid = FlatDisk<T, GridSheets<T, WithPattern>>;
  using Traced = FlatDisk<T, RaySheets<T>>;

  FlatEyeLookUpBatch batch;

  using Pixels = FlatEyePixels<T, LookUpFlatEyes>;

  ERGO_HD void operator()(int index) const { Pixels{batch.eye, *this}.draw(index); }

  //! Few lanes at a time are left to rays, but many of all samples.
  ERGO_HD void average(const Pixels& pixels, const T& x_px, const T& y_px, const Mask& lanes, SeenLanes<T>& sum) const {
    LeftSamples<T> left;
    for (int i = 0; i < near_samples * near_samples; ++i) {
      const NearSample<float> at = near_sample<float>(i);
      const T x = x_px + at.along;
      const T y = y_px + at.down;
      Mask wanted = lanes;
      Waiting waiting = {left, x, y};
      sum = sum + pixels.look(x, y, at.width, wanted, waiting);
    }
    for (int first = 0; first < left.count; first += RealTraits<T>::lane_count) {
      trace(pixels, left, first, sum);
    }
  }

  ERGO_HD Mask look_near(const EyeLine<T>& line, const SheetSearch<float>& search, float pixel, const Mask& wanted,
                         SeenLanes<T>& seen) const {
    GridSheets<T, WithPattern> sheets(batch);
    Grid disk(batch.eye, sheets, line, search, pixel);
    const Mask left = disk.meet(wanted);
    T fine(0.0F);
    compose(disk, wanted & !left, seen, fine);
    if (any(left)) {
      RaySheets<T> rays(batch.eye);
      Traced traced(batch.eye, rays, line, search, pixel);
      traced.meet_near(disk, left);
      compose(traced, left, seen, fine);
    }
    return fine > T(0.0F);
  }

  //! Where samples wait, and where in the image they are.
  struct Waiting {
    LeftSamples<T>& left;
    const T& x_px;
    const T& y_px;
  };

  //! The same, but that what the grid leaves to rays waits, as if nothing were seen there: not even through.
  ERGO_HD Mask look_near(const EyeLine<T>& line, const SheetSearch<float>& search, float pixel, const Mask& wanted,
                         SeenLanes<T>& seen, Waiting& waiting) const {
    GridSheets<T, WithPattern> sheets(batch);
    Grid disk(batch.eye, sheets, line, search, pixel);
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
  //! Traces samples that have waited, a register of them, and adds what they see to their lanes.
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
    RaySheets<T> rays(batch.eye);
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

}  // namespace ergodome::inline ERGO_TARGET
