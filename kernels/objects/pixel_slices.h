#pragma once

#include "kernels/objects/object_sight.h"
#include "kernels/spacetime/geodesic/radial_potential.h"

// Positions of samples in a pixel beside the shadow's edge.
//
// Towards the edge images follow each other in a geometric series: each is nearer to the edge than
// the one before and as much thinner, by a factor of about 23 without spin. Along the edge they
// change slowly. So the pixel is cut into slices along the edge, with one ray each, and slices are
// thinner nearer to the edge.
namespace ergodome::inline ERGO_TARGET {

//! A position in a pixel, from its corner. Its weight is the fraction of the pixel that it
//! represents, times the number of positions.
struct PixelPosition {
  double along_px, down_px;
  float weight;
};

//! A pixel that is cut into slices parallel to the shadow's edge.
class PixelSlices {
 public:
  PixelSlices() = default;

  //! `x`, `y`: unit vector from the edge outwards. `edge_px`: distance of the edge from the pixel's
  //! middle in that direction.
  ERGO_HD PixelSlices(double x, double y, double edge_px)
      : x_(x), y_(y), edge_px_(edge_px), first_(root(-reach() - edge_px)), last_(root(reach() - edge_px)) {}

  //! Returns the position of one of `count` slices, numbered from the dark side of the edge
  //! outwards.
  ERGO_HD PixelPosition position(int slice, int count) const {
    // Multiples of the golden ratio are spread evenly along the edge, for any number of slices.
    constexpr double golden = 0.61803398874989485;
    const double from = at(slice, count);
    const double to = at(slice + 1, count);
    const double across = at(slice + 0.5, count);
    double minimum = -1.0;
    double maximum = 1.0;
    keep_within(-y_, x_ * across, minimum, maximum);
    keep_within(x_, y_ * across, minimum, maximum);
    const double turns = (slice + 0.5) * golden;
    const double beside = minimum + (turns - ::floor(turns)) * (maximum - minimum);
    return {0.5 + x_ * across - y_ * beside, 0.5 + y_ * across + x_ * beside,
            static_cast<float>(count * (area_before(to) - area_before(from)))};
  }

 private:
  //! Returns the maximum distance of the corners from the middle, across the edge [px].
  ERGO_HD double reach() const { return 0.5 * (::fabs(x_) + ::fabs(y_)); }

  //! Slices are equally wide in the square root of the distance from the edge. On the dark side
  //! light of objects outside the photon sphere does not go farther round the hole, so slices are
  //! wider there.
  static constexpr double dark_part = 0.5;
  ERGO_HD static double root(double outside_px) {
    return outside_px > 0.0 ? ::sqrt(outside_px) : -dark_part * ::sqrt(-outside_px);
  }
  //! Returns where a slice begins: distance from the pixel's middle, perpendicular to the edge
  //! [px].
  ERGO_HD double at(double slice, int count) const {
    const double r = first_ + (last_ - first_) * (slice / count);
    const double square = r * r;
    const double outside_px = r > 0.0 ? square : -square / (dark_part * dark_part);
    return ::fmax(-reach(), ::fmin(reach(), edge_px_ + outside_px));
  }

  //! Returns the fraction of the pixel on the dark side of a line parallel to the edge, at distance
  //! `across` from the pixel's middle [px].
  ERGO_HD double area_before(double across) const {
    const double longer = ::fmax(::fabs(x_), ::fabs(y_));
    const double shorter = ::fmin(::fabs(x_), ::fabs(y_));
    const double off = ::fabs(across);
    const double rest = ::fmax(reach() - off, 0.0);
    double beyond = 0.0;
    if (off < 0.5 * (longer - shorter)) {
      beyond = 0.5 - off / longer;
    } else if (rest > 0.0) {
      beyond = rest * rest / (2.0 * longer * shorter);
    }
    return across < 0.0 ? beyond : 1.0 - beyond;
  }

  //! Restricts a range of t to where a line is within the pixel: |rate t + start| <= 1/2.
  ERGO_HD static void keep_within(double rate, double start, double& minimum, double& maximum) {
    if (::fabs(rate) < 1e-9) {
      return;
    }
    const double one = (-0.5 - start) / rate;
    const double other = (0.5 - start) / rate;
    minimum = ::fmax(minimum, ::fmin(one, other));
    maximum = ::fmin(maximum, ::fmax(one, other));
  }

  double x_ = 1.0;
  double y_ = 0.0;
  double edge_px_ = 0.0;
  //! The pixel's range is first_ to last_, as root() of the distance outwards from the edge.
  double first_ = 0.0;
  double last_ = 0.0;
};

//! Returns a ray in units of its energy at infinity, which has to be above 0.
template <class T>
ERGO_HD RayStart<T> in_unit_of_energy(const NearRay<T>& ray) {
  const T unit = 1.0 / ray.energy;
  return {unit * ray.axial_angular_momentum,
          unit * unit * ray.polar_constant,
          unit * unit * ray.shear_constant,
          ray.u,
          unit * ray.u_rate,
          ray.m,
          unit * ray.m_rate,
          ray.energy};
}

//! Cuts a pixel along the shadow's edge, which is found from the darkness of the ray in its middle
//! and the derivatives of that along the picture's x and y
//! (kernels/spacetime/geodesic/radial_potential.h). If these do not locate the edge, cuts the pixel
//! evenly from left to right.
ERGO_HD PixelSlices slice_pixel(const CameraStation& camera, const NearRay<Dual<double>>& ray) {
  constexpr double far_away_px = 1e3;
  const PixelSlices even(1.0, 0.0, -far_away_px);
  if (!(ray.energy.value > 0.0)) {
    return even;
  }
  const Dual<double> dark = darkness(camera.spin, camera.horizon_r, in_unit_of_energy(ray));
  const double slope = ::sqrt(dark.along_x * dark.along_x + dark.along_y * dark.along_y);
  const double edge_px = dark.value / slope;
  // If edge_px is NaN, the edge is not located.
  return slope > 0.0 && ::fabs(edge_px) < far_away_px
             ? PixelSlices(-dark.along_x / slope, -dark.along_y / slope, edge_px)
             : even;
}

//! Returns the observer's direction through the center of a pixel of a batch, with its derivatives
//! per pixel along the picture's x and y.
ERGO_HD Vector3<Dual<double>> middle_of_pixel(const ObjectPixelBatch& batch, int at) {
  const std::int32_t* const pixel = batch.pixels + 2 * static_cast<long>(at);
  return observed_footprint(batch.objects, pixel[0] + 0.5, pixel[1] + 0.5);
}

//! Returns x and y of a pixel of a batch; past the last one, those of the last.
ERGO_HD const std::int32_t* pixel_of_batch(const ObjectPixelBatch& batch, int at) {
  return batch.pixels + 2 * static_cast<long>(at < batch.count ? at : batch.count - 1);
}

//! Positions of the samples of some pixels of a batch, in quads of neighboring positions.
template <int Pixels>
class PixelPositions {
 public:
  //! Computes the positions for the pixels from `first` on; slice(number) returns the slices of one
  //! pixel.
  template <class Slice>
  ERGO_HD PixelPositions(const ObjectPixelBatch& batch, int first, const Slice& slice)
      : pattern_(batch.pattern), samples_(batch.samples) {
    for (int i = 0; i < Pixels && pattern_ == PixelPattern::slices; ++i) {
      slices_[i] = slice(first + i < batch.count ? first + i : batch.count - 1);
    }
  }

  //! Returns position k of a quad.
  ERGO_HD PixelPosition at(int pixel, int quad, int k) const {
    if (pattern_ == PixelPattern::slices) {
      return slices_[pixel].position(4 * quad + k, samples_ * samples_);
    }
    const int across = samples_ / 2;
    const int row = quad / across;
    const int column = quad - row * across;
    const int below = k / 2;
    return {(2 * column + k % 2 + 0.5) / samples_, (2 * row + below + 0.5) / samples_, 1.0F};
  }

 private:
  PixelPattern pattern_;
  int samples_;
  PixelSlices slices_[Pixels];
};

}  // namespace ergodome::inline ERGO_TARGET
