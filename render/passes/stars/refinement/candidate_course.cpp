#include "render/passes/stars/refinement/candidate_course.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "render/passes/stars/drawing/edge_rounding.h"

namespace ergodome {

namespace {

//! Smaller singular value of the lens map below which rounding errors in single precision displace
//! an image visibly.
constexpr double steepest = 0.1;
//! Accepted relative change of the magnification by rounding errors in single precision.
constexpr double max_change = 0.01;
//! A candidate whose rays stay farther than this from any image position is not an image [px]. Next
//! to a caustic, where images move along the caustic, the distance to the star counts instead.
constexpr double near_px = 2.0;
//! Minimum distance from the shadow's edge at which single-precision rays can prove that there is
//! no image, or that it is too faint [rad]. Closer to it, and next to caustics, some
//! single-precision rays go astray.
constexpr double min_float_distance = 1e-3;
//! Number of rounds (Newton steps) after which most images are found.
constexpr int first_rounds = 4;
//! Number of rounds for candidates that are not lost (`lost_miss`) after `first_rounds`. It is the
//! maximum in single precision; in double precision there may be more.
constexpr int on_way_rounds = 6;
//! Maximum number of double-precision rounds, for candidates that are near an image after
//! `on_way_rounds` (`hopeless_miss`).
constexpr int max_course_rounds = 24;
//! A candidate whose `miss` exceeds this after the first rounds does not converge; in units of the
//! distance to the shadow's edge.
constexpr double lost_miss = 2.0;
//! A `miss` above this means that no light arrives from the candidate's direction [rad].
constexpr double no_light = 1e29;
constexpr double nowhere = 1e30;
//! A candidate whose miss exceeds this after on_way_rounds will not converge; as a fraction of the
//! distance to the shadow's edge.
constexpr double hopeless_miss = 0.02;
//! The limit `hopeless_miss` for candidates that may be very bright.
constexpr double dazzling_miss = 0.5;
//! Reported changes of the magnification above this are not accurate; they only mean that the
//! magnification changes much.
constexpr double max_decisive_change = 0.5;
//! Minimum distance between a star and a fold that double-precision rays can resolve [rad].
constexpr double min_shortfall = 1e-8;

//! Returns whether another round may improve a candidate.
bool is_open(const StarCandidate& c, double miss) {
  return (c.miss > miss || c.change > max_magnification_change) && c.miss < no_light;
}

//! Returns whether the rounds of a candidate do not converge.
bool is_lost(const StarCandidate& c) { return c.miss > lost_miss * c.edge_distance; }

//! Returns whether a candidate that is too faint at its last ray is also too faint at all nearby
//! positions. A candidate that does not converge steadily may reach a position where it is many
//! times brighter; next to caustics nothing else is known.
bool stays_faint(const StarCandidate& c, const ImageSearch& search) {
  constexpr double min_slack = 1.3;
  // The reported change is an estimate; in places the true change is up to twice as large.
  constexpr double between = 3.0;
  constexpr double far_slack = 20.0;
  return c.solid_angle != 0.0 &&
         search.brightness(c) * (c.change < max_decisive_change ? min_slack + between * c.change : far_slack) < 1.0;
}

//! Returns whether single-precision rays can prove that a candidate is not an image. Without a
//! chart they cannot, because the distance to the shadow's edge is unknown.
bool float_suffices(const StarCandidate& c, const ImageSearch& search) {
  return search.chart.chart.edge.count > 0 && c.edge_distance > min_float_distance;
}

//! Returns whether a candidate that has not converged is dropped because it is too faint.
bool is_left(const StarCandidate& c, const CandidateCourse& course, const ImageSearch& search) {
  return search.brightness && course.rounds <= first_rounds &&
         (course.rounds == 1 || c.change >= max_decisive_change) &&
         (course.rays != RayKind::quick || float_suffices(c, search)) && stays_faint(c, search);
}

//! Returns whether a candidate that has not converged should get another ray of the same kind.
bool is_worth_more(const StarCandidate& c, const CandidateCourse& course, const ImageSearch& search, double miss) {
  if (course.rounds < first_rounds) {
    return true;
  }
  if (course.rounds == first_rounds) {
    return !is_lost(c);
  }
  if (course.rounds < on_way_rounds) {
    return true;
  }
  // Candidates that may be very bright get more rounds. Near a point that maps to a whole ring,
  // rays need many rounds, but images are very bright.
  constexpr double dazzling = 100.0;
  const bool dazzles = course.rays == RayKind::finest && search.brightness && search.brightness(c) > dazzling;
  const bool is_near = c.miss > miss && c.miss < (dazzles ? dazzling_miss : hopeless_miss) * c.edge_distance;
  return course.rays != RayKind::quick && course.rounds < max_course_rounds &&
         (course.rounds > on_way_rounds || is_near);
}

//! Returns the smaller singular value of the map to the sky, signed by parity.
double signed_smaller(const StarCandidate& c) {
  return std::copysign(std::sqrt(singular_values(c).smaller_square), c.solid_angle);
}

//! Returns the distance between a star and the fold at which the sky turns back before it reaches
//! the star [rad]; 0 if the sky may reach the star. Arguments: smaller singular value s before and
//! after (s') a Newton step, and the length x of the step.
//!
//! Across a fold, the position on the sky is a parabola in the position in the view, f(x) = s x + c
//! x² / 2, and the step is x = f / s, where f is the distance to the star. So c = (s' - s) / x, and
//! a real root requires s² + 2 c f = s (2 s' - s) >= 0. Otherwise f is out of reach by the absolute
//! value of that, divided by 2 c.
double fold_short_of(double s, double s_after, double length) {
  const double root = s * (2.0 * s_after - s);
  return root < 0.0 ? 0.5 * length * std::abs(root / (s_after - s)) : 0.0;
}

//! Returns whether a candidate is not an image because its star is beyond a fold of the sky: the
//! last two estimates of the star's distance from the fold agree within a factor of 2, and the
//! distance is larger than the diameter of the star's disk and `min_shortfall`.
bool is_beyond_fold(const StarCandidate& c, CandidateCourse& course) {
  constexpr double max_disagreement = 2.0;
  constexpr double min_disks = 2.0;
  // Longer steps lead to other folds: around a ring, or beside the shadow's edge.
  constexpr double longest = 0.25;
  const bool is_reliable =
      course.rounds >= 2 && course.rays != RayKind::quick && course.miss <= longest * c.edge_distance;
  const double short_of = is_reliable ? fold_short_of(course.smaller, signed_smaller(c), course.miss) : 0.0;
  const double before = std::exchange(course.short_of, short_of);
  return short_of > std::max(min_disks * c.radius, min_shortfall) && short_of < max_disagreement * before &&
         before < max_disagreement * short_of;
}

//! Returns the relative change of the magnification by rounding errors in single precision. The
//! lens map varies on the scale of the distance to the shadow's edge; next to a caustic, it varies
//! faster, by one over the square of its smaller singular value.
double change_by_rounding(const StarCandidate& c, const SingularValues& values) {
  return edge_rounding / (c.edge_distance * std::min(values.smaller_square, 1.0));
}

//! Returns whether single-precision rays prove that a candidate is not an image.
bool float_denies(const StarCandidate& c, const ImageSearch& search) {
  const double smaller = std::min(std::sqrt(singular_values(c).smaller_square), 1.0);
  return float_suffices(c, search) && (is_lost(c) || c.miss * smaller > near_px * search.pixel);
}

//! Returns whether further single-precision rays are useless for a candidate that has not
//! converged: rounding errors dominate, or the search will restart in double precision anyway.
bool float_has_decided(const StarCandidate& c, const CandidateCourse& course, const ImageSearch& search) {
  constexpr double min_gain = 0.5;
  const SingularValues values = singular_values(c);
  if (c.miss <= last_miss(RayKind::quick, search.pixel) && values.smaller_square >= steepest * steepest) {
    const double rounding = change_by_rounding(c, values);
    return rounding > max_change && c.change < std::min(rounding, max_decisive_change);
  }
  return !float_denies(c, search) &&
         (values.smaller_square < steepest * steepest || (course.rounds > 1 && c.miss > min_gain * course.miss));
}

//! Where the double-precision search for an image starts.
enum class Start {
  none,  //!< no search in double precision: not needed, or there is no image
  //! At the single-precision position, because rounding errors affect only the magnification.
  found,
  //! At the position from the grid, because the single-precision search may have gone astray where
  //! the sky hardly changes with the direction.
  rough
};

Start double_start(const StarCandidate& c, const ImageSearch& search) {
  if (c.faint) {
    return Start::none;
  }
  if (float_denies(c, search)) {
    return Start::none;
  }
  const SingularValues values = singular_values(c);
  if (!(c.miss <= last_miss(RayKind::quick, search.pixel)) || values.smaller_square < steepest * steepest) {
    return Start::rough;
  }
  return change_by_rounding(c, values) > max_change ? Start::found : Start::none;
}

//! Returns whether a candidate next to a caustic needs the finest rays: its `miss` is at most
//! `near_px`, and it is not too faint. Most candidates there are not images, so only such ones get
//! the more expensive rays.
bool needs_finest(const StarCandidate& c, const ImageSearch& search) {
  // A candidate whose miss is below this fraction of the distance to the shadow's edge has about
  // the brightness of the image.
  constexpr double hair = 0.05;
  constexpr double slack = 4.0;
  const bool beside_caustic =
      c.miss > last_miss(RayKind::fine, search.pixel) || singular_values(c).smaller_square < steepest * steepest;
  const bool faint = search.brightness && c.miss < hair * c.edge_distance && search.brightness(c) * slack < 1.0;
  return c.miss <= near_px * search.pixel && beside_caustic && !faint;
}

//! Returns whether a candidate next to a caustic moves only by short steps. Such a candidate
//! continues with the finest rays, which are needed anyway, instead of converging with less precise
//! ones first.
bool is_settled_beside_caustic(const StarCandidate& c, const ImageSearch& search) {
  return c.change < max_decisive_change && singular_values(c).smaller_square < steepest * steepest &&
         needs_finest(c, search);
}

//! Returns whether further rays of the current kind cannot improve a candidate that has not
//! converged, although another kind may.
bool has_decided(const StarCandidate& c, const CandidateCourse& course, const ImageSearch& search) {
  switch (course.rays) {
    case RayKind::quick:
      return float_has_decided(c, course, search);
    case RayKind::fine:
      return course.led_away && is_settled_beside_caustic(c, search);
    case RayKind::finest:
      break;
  }
  return false;
}

std::optional<RayKind> begin_with(RayKind rays, CandidateCourse& course) {
  course.rays = rays;
  course.rounds = 0;
  course.short_of = 0.0;
  return rays;
}

//! Starts double-precision rays at a position found in single precision. Normalizes the position: a
//! length other than 1 would displace the image by up to a hundredth of a pixel where the lens map
//! is steep.
std::optional<RayKind> begin_in_double(RayKind rays, const Vector3<double>& position, StarCandidate& c,
                                       CandidateCourse& course) {
  c.direction = (1.0 / std::sqrt(dot(position, position))) * position;
  return begin_with(rays, course);
}

//! Returns the kind of rays with which the search continues after the current one, if it does.
std::optional<RayKind> next_kind(StarCandidate& c, CandidateCourse& course, const ImageSearch& search) {
  if (course.rays == RayKind::quick) {
    switch (double_start(c, search)) {
      case Start::none:
        return std::nullopt;
      case Start::found:
        return search.wanted(c) ? begin_in_double(RayKind::fine, c.direction, c, course) : std::nullopt;
      case Start::rough:
        course.led_away = true;
        return begin_in_double(is_settled_beside_caustic(c, search) ? RayKind::finest : RayKind::fine, course.begin, c,
                               course);
    }
  }
  if (course.rays == RayKind::fine && course.led_away && needs_finest(c, search)) {
    return begin_with(RayKind::finest, course);
  }
  return std::nullopt;
}

}  // namespace

std::optional<RayKind> next_ray(StarCandidate& candidate, CandidateCourse& course, const ImageSearch& search) {
  ++course.rounds;
  const double miss = last_miss(course.rays, search.pixel);
  if (is_open(candidate, miss)) {
    if (is_left(candidate, course, search)) {
      candidate.miss = nowhere;
      candidate.faint = true;
    } else if (is_beyond_fold(candidate, course)) {
      candidate.miss = nowhere;
    } else if (is_worth_more(candidate, course, search, miss) && !has_decided(candidate, course, search)) {
      course.miss = candidate.miss;
      course.smaller = signed_smaller(candidate);
      return course.rays;
    }
  }
  return next_kind(candidate, course, search);
}

}  // namespace ergodome
