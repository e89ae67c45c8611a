#pragma once

#include "kernels/core/find_root.h"
#include "kernels/objects/mesh_search.h"
#include "kernels/objects/object_sight.h"

// The curve in space along which an eye of the stereo model `flat` looks.
//
// What the head sees in direction n at the affine distance d is at d n in its flat space
// (kernels/eyes/flat/eye_line.h). So a line of sight e + s m of an eye at e is a curve in space: at
// the nearness w = 1/s it is on the head's ray in the direction of m + w e, at the distance |m + w
// e| / w. The curve meets objects as a ray does, whatever their surface, and whichever way round
// the hole they are seen.
//
// While the directions change little, one ray with its derivatives by direction predicts its
// neighbors. Where light has gone round the hole so often that neighbors are in entirely different
// positions, images are far thinner than a pixel, and the ray itself represents all that is near to
// it.
namespace ergodome::inline ERGO_TARGET {

//! One of the head's rays, which represents the part of an eye's line near to it.
struct EyeReference {
  Vector3<double> m;    //!< direction of the eye's line of sight
  Vector3<double> eye;  //!< e: the eye, relative to the head [M]
  Vector3<double> n;    //!< the ray's direction, from the head
  //! Unit vectors perpendicular to n, along which the ray is differentiated.
  Vector3<double> across;
  Vector3<double> down;

  //! Returns the direction in which the head sees the point of the line at nearness w. `length`
  //! receives the length of the direction vector before normalization.
  ERGO_HD Vector3<double> toward(double w, double& length) const {
    const Vector3<double> v = m + w * eye;
    length = ::sqrt(dot(v, v));
    return (1.0 / length) * v;
  }

  //! Returns the distance from the head of the line's point at nearness w [M]; infinite at nearness
  //! 0.
  ERGO_HD double distance(double w) const {
    double length = 0.0;
    toward(w, length);
    return w > 0.0 ? length / w : std::numeric_limits<double>::infinity();
  }

  //! Returns the nearness at a distance from the head: (d² - e²) w² - 2 w m·e = 1. A line that
  //! passes the head has two solutions for distances below |e|; the farther one is returned. If
  //! there is none, returns the nearness of the line's point closest to the head, or a huge value
  //! if that point is the eye.
  ERGO_HD double nearness(double distance) const {
    const double ahead = dot(m, eye);
    const double rest = distance * distance - dot(eye, eye);
    const double root = ::sqrt(::fmax(ahead * ahead + rest, 0.0));
    constexpr double beyond_all = 1e9;
    if (ahead < 0.0) {
      return 1.0 / (root - ahead);
    }
    return rest > 0.0 ? ::fmin((ahead + root) / rest, beyond_all) : beyond_all;
  }
};

//! A section of a line of sight, as a range of distances from the head [M].
struct DistanceSpan {
  double nearest, farthest;
};

//! Returns a ray through the middle of a part of an eye's line, with the axes along which its
//! derivatives are taken.
ERGO_HD EyeReference eye_reference(const Vector3<double>& m, const Vector3<double>& eye, double w) {
  EyeReference reference = {m, eye, {}, {}, {}};
  double length = 0.0;
  reference.n = reference.toward(w, length);
  const Vector3<double>& n = reference.n;
  const Vector3<double> helper = ::fabs(n.x) < 0.6 ? Vector3<double>{1.0, 0.0, 0.0} : Vector3<double>{0.0, 1.0, 0.0};
  const Vector3<double> across = cross(n, helper);
  reference.across = (1.0 / ::sqrt(dot(across, across))) * across;
  reference.down = cross(n, reference.across);
  return reference;
}

//! The curves of an eye and its neighbors along a step of their reference ray.
template <int Order, NearParts Parts>
class EyeStep {
 public:
  using D = Dual<double>;

  //! `reach`: maximum angle between the reference ray and the directions that it represents [rad].
  ERGO_HD EyeStep(const PathStep<Order, Parts, D>& step, const EyeReference& reference, double reach)
      : step_(step), reference_(reference), reach_(reach) {
    first_ = step.series.distance[0];
    last_ = with_neighbours(step.series.distance, step.length);
    beside_ = reach * ::fmax(change_of(first_), change_of(last_));
    // If the distance of the eye's line may differ from the ray's by a large fraction, the ray
    // itself is used for all neighbors.
    parts_ = !(beside_ < 0.1 * last_.value);
    beside_ = parts_ ? 0.0 : beside_;
  }

  //! Returns whether the whole step is farther from the head than `farthest` [M].
  [[nodiscard]] ERGO_HD bool begins_beyond(double farthest) const { return !(first_.value - beside_ < farthest); }

  //! Restricts the step to the part that may be within a span of distances from the head. Returns
  //! false if there is no such part.
  ERGO_HD bool keep(const DistanceSpan& span) {
    if (length_ > 0.0 && span.nearest == kept_.nearest && span.farthest == kept_.farthest) {
      return true;
    }
    kept_ = span;
    length_ = 0.0;
    const double from = span.nearest - beside_;
    const double to = span.farthest + beside_;
    if (!(first_.value < to) || !(last_.value > from)) {
      return false;
    }
    const double end = step_.length;
    const auto come_to = [&](double distance) {
      return find_root(0.0, end, [&](double h) { return distance_of_ray(h) - distance; });
    };
    begin_ = first_.value < from ? come_to(from) : 0.0;
    length_ = (last_.value > to ? come_to(to) : end) - begin_;
    moved_ = false;
    return length_ > 0.0;
  }

  //! Returns whether the part of the step that keep() has selected may come near any mesh. Also
  //! sets width_ and bends_, once for each step.
  [[nodiscard]] ERGO_HD bool may_meet(const MeshScene& scene) {
    const Vector3<D> first_point = point_with_neighbours(0.0);
    const Vector3<D> last_point = point_with_neighbours(step_.length);
    width_ = ::fmax(width_of(first_point), width_of(last_point));
    bends_ = parts_ || bends(first_point, first_) || bends(last_point, last_);
    const double end = begin_ + length_;
    const auto point = [&](double h) { return point_of_ray(h); };
    // Most steps are kept as a whole, and the points at their ends have already been computed.
    const PathPiece piece = {0.0, length_, begin_ == 0.0 ? plain_vector(first_point) : point(begin_),
                             point(begin_ + 0.5 * length_),
                             end == step_.length ? plain_vector(last_point) : point(end)};
    // Steps are longer than pieces and less similar to parabolas, so their reach is doubled. If the
    // ray itself is used for its neighbors (bends_), their distance from it is 0.
    const double beside = bends_ ? 0.0 : width_ * reach_;
    const double reach = 2.0 * piece.stray() + ::fabs(piece.unevenness()) * piece.chord() + beside;
    for (int i = 0; i < scene.count; ++i) {
      const PlacedMesh& mesh = scene.meshes[i];
      const double radius = mesh.size * mesh.tree.radius;
      if (mesh.retarded ||
          !(distance_from_segment(ball_middle(mesh, mesh.position), piece.from, piece.to) > radius + reach)) {
        return true;
      }
    }
    return false;
  }

  //! Selects the direction of a neighboring line of sight for the calls that follow.
  ERGO_HD void turn_to(const Vector3<double>& m) { reference_.m = m; }

  //! Returns the eye's path along the part of the step that keep() has selected, without
  //! derivatives by direction. The eye's offset from the reference ray is approximated by a
  //! parabola in the ray's time.
  [[nodiscard]] ERGO_HD PathStep<Order, Parts, double> along() {
    if (!moved_) {
      move_to_begin();
    }
    PathStep<Order, Parts, double> path;
    const Position at[3] = {position(begin_), position(begin_ + 0.5 * length_), position(begin_ + length_)};
    const Parabola across = {at[0].across, at[1].across, at[2].across, length_};
    const Parabola down = {at[0].down, at[1].down, at[2].down, length_};
    const auto fold = [&](const auto& from, auto& to) { fold_series(from, across, down, to); };
    fold(series_.u, path.series.u);
    fold(series_.x, path.series.x);
    fold(series_.y, path.series.y);
    fold(series_.z, path.series.z);
    fold(series_.drag, path.series.drag);
    fold(series_.distance, path.series.distance);
    if constexpr (has_delay(Parts)) {
      fold(series_.delay, path.series.delay);
    }
    path.axes[0] = step_.axes[0];
    path.axes[1] = step_.axes[1];
    path.min_u = step_.min_u;
    path.length = length_;
    path.scale = step_.scale;
    path.start = step_.start + begin_ / step_.scale;
    path.delay_at_camera = step_.delay_at_camera;
    return path;
  }

  //! Sets a hit's u_rate and polar_momentum to those of the head's ray there, and the hit's time to
  //! minus its nearness (1/distance from the eye), so that nearer hits come first. `h`: time on
  //! along().
  ERGO_HD void see(double h, MeshHit& hit) const {
    const Position at = position(begin_ + h);
    const D time(begin_ + h);
    const Vector3<D> momentum = step_.polar_momentum(time);
    hit.u_rate = beside(step_.scale * series_rate(step_.series.u, time), at);
    hit.polar_momentum = {beside(momentum.x, at), beside(momentum.y, at), beside(momentum.z, at)};
    hit.time = -reference_.nearness(at.distance);
  }

 private:
  //! Position of the eye's line at a time of the ray.
  struct Position {
    //! Angles from the reference ray to the line, as the head sees them, along EyeReference::across
    //! and down [rad].
    double across, down;
    double distance;  //!< distance from the head [M]
  };

  //! c[0] + c[1] t + c[2] t², through its values at three equally spaced t.
  struct Parabola {
    double c[3];

    ERGO_HD Parabola(double first, double middle, double last, double length)
        : c{first, (4.0 * middle - 3.0 * first - last) / length,
            2.0 * (first - 2.0 * middle + last) / (length * length)} {}
  };

  ERGO_HD Position position(double h) const {
    // Direction and distance are corrected in turn. A few rounds suffice, because the correction of
    // the distance changes the direction by only a small fraction of its offset.
    constexpr int rounds = 4;
    const D ray = with_neighbours(step_.series.distance, h);
    Position at = {0.0, 0.0, ray.value};
    for (int round = 0; round < rounds && !bends_; ++round) {
      double stretch = 0.0;
      const Vector3<double> aside = reference_.toward(reference_.nearness(at.distance), stretch) - reference_.n;
      at.across = dot(aside, reference_.across);
      at.down = dot(aside, reference_.down);
      at.distance = ray.value + ray.along_x * at.across + ray.along_y * at.down;
    }
    return at;
  }

  //! Evaluate a series at a time that is the same for the ray and its neighbors, with derivatives
  //! or for the ray alone. Most steps need no more, and times with derivatives would take three
  //! times as long.
  template <int Count>
  [[nodiscard]] ERGO_HD static D with_neighbours(const D (&c)[Count], double h) {
    D sum = c[Count - 1];
    for (int k = Count - 2; k >= 0; --k) {
      sum = {sum.value * h + c[k].value, sum.along_x * h + c[k].along_x, sum.along_y * h + c[k].along_y};
    }
    return sum;
  }
  template <int Count>
  [[nodiscard]] ERGO_HD static double of_ray(const D (&c)[Count], double h) {
    double sum = c[Count - 1].value;
    for (int k = Count - 2; k >= 0; --k) {
      sum = sum * h + c[k].value;
    }
    return sum;
  }

  [[nodiscard]] ERGO_HD double distance_of_ray(double h) const { return of_ray(step_.series.distance, h); }

  //! Return PathStep::point() at a time that is the same for the ray and its neighbors: with
  //! derivatives, and for the ray alone.
  [[nodiscard]] ERGO_HD Vector3<D> point_with_neighbours(double h) const {
    const auto& s = step_.series;
    const D u = with_neighbours(s.u, h);
    const D r = 1.0 / (u.value > step_.min_u ? u : D(step_.min_u));
    return r * step_.turned(with_neighbours(s.drag, h), with_neighbours(s.x, h), with_neighbours(s.y, h),
                            with_neighbours(s.z, h));
  }
  [[nodiscard]] ERGO_HD Vector3<double> point_of_ray(double h) const {
    const auto& s = step_.series;
    double sine = 0.0;
    double cosine = 1.0;
    sine_cosine(of_ray(s.drag, h), sine, cosine);
    const double x = of_ray(s.x, h);
    const double y = of_ray(s.y, h);
    const double r = 1.0 / ::fmax(of_ray(s.u, h), step_.min_u);
    return r * ((cosine * x - sine * y) * step_.axes[0] + (sine * x + cosine * y) * step_.axes[1] +
                Vector3<double>{0.0, 0.0, of_ray(s.z, h)});
  }

  ERGO_HD static double change_of(const D& distance) { return ::fabs(distance.along_x) + ::fabs(distance.along_y); }

  //! Returns how far the eye's lines of sight adjacent in the picture are from point `p` of this
  //! one, at the same time of their rays, per radian between the directions in which the head sees
  //! them [M]: the distances along both axes of the derivatives, added.
  ERGO_HD static double width_of(const Vector3<D>& p) {
    return length_of({p.x.along_x, p.y.along_x, p.z.along_x}) + length_of({p.x.along_y, p.y.along_y, p.z.along_y});
  }

  //! Returns whether adjacent lines of sight are so far from point `p`, or so much nearer to or
  //! farther from the head, that the reference ray's derivatives do not predict them.
  [[nodiscard]] ERGO_HD bool bends(const Vector3<D>& p, const D& distance) const {
    constexpr double widest = 0.5;
    constexpr double max_unevenness = 0.3;
    // The negated comparisons are also true if a value is NaN.
    return !(width_of(p) * reach_ <= widest * length_of(plain_vector(p))) ||
           !(change_of(distance) * length_of(reference_.eye) <= max_unevenness * distance.value * distance.value);
  }

  ERGO_HD static double beside(const D& value, const Position& at) {
    return value.value + value.along_x * at.across + value.along_y * at.down;
  }

  //! Moves the step's series to the beginning of the part that keep() has selected.
  ERGO_HD void move_to_begin() {
    series_ = step_.series;
    moved_ = true;
    if (begin_ == 0.0) {
      return;
    }
    move_series(series_.u);
    move_series(series_.x);
    move_series(series_.y);
    move_series(series_.z);
    move_series(series_.drag);
    move_series(series_.distance);
    if constexpr (has_delay(Parts)) {
      move_series(series_.delay);
    }
  }
  template <int Count>
  ERGO_HD void move_series(D (&c)[Count]) const {
    for (int i = 0; i + 1 < Count; ++i) {
      for (int k = Count - 2; k >= i; --k) {
        c[k] = c[k] + c[k + 1] * begin_;
      }
    }
  }

  //! Computes the series of a quantity along the eye's curve, about its beginning.
  template <int Count>
  ERGO_HD static void fold_series(const D (&from)[Count], const Parabola& across, const Parabola& down,
                                  double (&to)[Count]) {
    for (int k = 0; k < Count; ++k) {
      to[k] = from[k].value;
      for (int i = 0; i < 3 && i <= k; ++i) {
        to[k] += from[k - i].along_x * across.c[i] + from[k - i].along_y * down.c[i];
      }
    }
  }

  const PathStep<Order, Parts, D>& step_;
  EyeReference reference_;
  double reach_;
  //! Distance of the reference ray from the head at the beginning and at the end of the step [M].
  D first_;
  D last_;
  //! Maximum difference between the distances of the eye's line and of the ray from the head [M].
  //! If it would be a large fraction of the distance, it is 0 and parts_ is true: the ray itself
  //! then serves for all neighbors.
  double beside_;
  bool parts_ = false;
  DistanceSpan kept_ = {0.0, 0.0};
  double begin_ = 0.0;  //!< beginning of the part that keep() has selected, in the step's time
  double length_ = 0.0;
  bool moved_ = false;  //!< series_ has been moved to begin_
  detail::NearSeries<Order, D, Parts> series_;
  double width_ = 0.0;
  bool bends_ = false;
};

}  // namespace ergodome::inline ERGO_TARGET
