#include "render/passes/stars/search/candidate_course.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "render/passes/stars/drawing/edge_rounding.h"

namespace ergodome {

namespace {

//! Smaller singular value of the map to the sky below which float's rounding is seen in an image's place.
constexpr double steepest = 0.1;
//! Change of the magnification that float's rounding may make, as a part of it.
constexpr double most_change = 0.01;
//! What rays have not brought so near to an image has none [px]; next to a caustic, where images run along it, so near to the star.
constexpr double near_px = 2.0;
//! Nearer to the shadow's edge rays in float tell neither that, nor that an image is too faint: next to a caustic some lead astray [rad].
constexpr double least_float_distance = 1e-3;
//! Rounds in which most images are found.
constexpr int first_rounds = 4;
//! And after those that are on their way.
constexpr int on_way_rounds = 6;
//! And in which those are, in double, that lie next to caustics, far from where they are sought.
constexpr int most_course_rounds = 24;
//! What is farther than this after the first rounds is on no way: it leaps about, in distances to the shadow's edge.
constexpr double lost_miss = 2.0;
//! Larger misses say that no light came [rad].
constexpr double no_light = 1e29;
constexpr double nowhere = 1e30;
//! What goes farther than this after the rounds of those on their way will not come to an end, as a part of the distance to the shadow's
//! edge.
constexpr double hopeless_miss = 0.02;
//! The same for what may be very bright.
constexpr double dazzling_miss = 0.5;
//! Larger changes of the magnification over a step are but told as large.
constexpr double most_change_told = 0.5;
//! How far from a star the sky has to end at least, for rays in double to tell it [rad].
constexpr double least_short_of = 1e-8;

//! Whether another round would tell more of an image.
bool is_open(const StarCandidate& c, double miss) {
  return (c.miss > miss || c.change > most_magnification_change) && c.miss < no_light;
}

//! Whether rounds have led an image nowhere.
bool is_lost(const StarCandidate& c) { return c.miss > lost_miss * c.edge_distance; }

//! Whether an image that is so faint where its last ray came from is bright enough nowhere near; one that leaps about may come to a place
//! where it is many times as bright, and next to caustics that is all that is known.
bool stays_faint(const StarCandidate& c, const ImageSearch& search) {
  constexpr double least_slack = 1.3;
  // What the last step changes is told as most change at the most, and here and there up to twice that.
  constexpr double between = 3.0;
  constexpr double far_slack = 20.0;
  return c.solid_angle != 0.0 &&
         search.brightness(c) * (c.change < most_change_told ? least_slack + between * c.change : far_slack) < 1.0;
}

//! Whether rays in float tell where there is no image. Without a chart, how near the edge is is not known.
bool float_tells(const StarCandidate& c, const ImageSearch& search) {
  return search.chart.chart.edge.count > 0 && c.edge_distance > least_float_distance;
}

//! Whether an open candidate is too faint to go on.
bool is_left(const StarCandidate& c, const CandidateCourse& course, const ImageSearch& search) {
  return search.brightness && course.rounds <= first_rounds && (course.rounds == 1 || c.change >= most_change_told) &&
         (course.rays != RayKind::quick || float_tells(c, search)) && stays_faint(c, search);
}

//! Whether a candidate that is open is worth another ray of the same kind.
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
  // Next to a point that all of a ring leads to, rays go round it for long; its light is all the more.
  constexpr double dazzling = 100.0;
  const bool dazzles = course.rays == RayKind::finest && search.brightness && search.brightness(c) > dazzling;
  const bool is_near = c.miss > miss && c.miss < (dazzles ? dazzling_miss : hopeless_miss) * c.edge_distance;
  return course.rays != RayKind::quick && course.rounds < most_course_rounds &&
         (course.rounds > on_way_rounds || is_near);
}

//! The smaller singular value of the map to the sky, with the sign of the parity.
double signed_smaller(const StarCandidate& c) {
  return std::copysign(std::sqrt(singular_values(c).smaller_square), c.solid_angle);
}

//! How far from a star the sky is folded back before it reaches it, by a step of Newton's method over a length, between whose ends the
//! smaller singular value s changed [rad]; 0 where the sky may reach it.
//!
//! Across a fold the sky is a parabola, f(x) = s x + c x² / 2, and a step x = f / s; so c = (s' - s) / x, and a root that is real asks for
//! s² + 2 c f = s (2 s' - s) >= 0. Else f is missed by that over 2 c.
double fold_short_of(double s, double s_after, double length) {
  const double root = s * (2.0 * s_after - s);
  return root < 0.0 ? 0.5 * length * std::abs(root / (s_after - s)) : 0.0;
}

//! Whether there is no image where a candidate is sought: its star lies beyond a fold, by as much as its last rays and those before said. Its disk
//! does not reach there.
bool is_beyond_fold(const StarCandidate& c, CandidateCourse& course) {
  constexpr double most_unlike = 2.0;
  constexpr double least_disks = 2.0;
  // Longer steps lead to where the sky is folded in other ways: round a ring, or at the next fold beside the shadow's edge.
  constexpr double longest = 0.25;
  const bool tells = course.rounds >= 2 && course.rays != RayKind::quick && course.miss <= longest * c.edge_distance;
  const double short_of = tells ? fold_short_of(course.smaller, signed_smaller(c), course.miss) : 0.0;
  const double before = std::exchange(course.short_of, short_of);
  return short_of > std::max(least_disks * c.radius, least_short_of) && short_of < most_unlike * before &&
         before < most_unlike * short_of;
}

//! What float's rounding changes an image's magnification by, as a part of it. The map changes on the scale of the distance to the shadow's
//! edge, and next to a caustic faster by one over the square of its smaller singular value.
double change_by_rounding(const StarCandidate& c, const SingularValues& values) {
  return edge_rounding / (c.edge_distance * std::min(values.smaller_square, 1.0));
}

//! Whether rays in float say that there is no image.
bool float_denies(const StarCandidate& c, const ImageSearch& search) {
  const double smaller = std::min(std::sqrt(singular_values(c).smaller_square), 1.0);
  return float_tells(c, search) && (is_lost(c) || c.miss * smaller > near_px * search.pixel);
}

//! Whether rays in float have told what they can of a candidate that is open: where their rounding leads, or where double begins anew.
bool float_has_told(const StarCandidate& c, const CandidateCourse& course, const ImageSearch& search) {
  constexpr double least_gain = 0.5;
  const SingularValues values = singular_values(c);
  if (c.miss <= last_miss(RayKind::quick, search.pixel) && values.smaller_square >= steepest * steepest) {
    const double rounding = change_by_rounding(c, values);
    return rounding > most_change && c.change < std::min(rounding, most_change_told);
  }
  return !float_denies(c, search) &&
         (values.smaller_square < steepest * steepest || (course.rounds > 1 && c.miss > least_gain * course.miss));
}

//! Where double has to seek an image.
enum class Start {
  none,   //!< it needs not to, or there is none
  found,  //!< from where float has it: its rounding shows in the magnification alone
  rough   //!< from where the grid has it: float may have led away, where the sky hardly moves when the camera turns
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
  return change_by_rounding(c, values) > most_change ? Start::found : Start::none;
}

//! Whether rays in double have brought a candidate next to a caustic. Most of what is sought there is none: only what came near is worth
//! rays that cost more.
bool needs_finest(const StarCandidate& c, const ImageSearch& search) {
  // A hair beside where it is found, an image is about as bright.
  constexpr double hair = 0.05;
  constexpr double slack = 4.0;
  const bool beside_caustic =
      c.miss > last_miss(RayKind::fine, search.pixel) || singular_values(c).smaller_square < steepest * steepest;
  const bool faint = search.brightness && c.miss < hair * c.edge_distance && search.brightness(c) * slack < 1.0;
  return c.miss <= near_px * search.pixel && beside_caustic && !faint;
}

//! Whether a candidate's next steps are short and next to a caustic: less exact rays need not end what the finest will.
bool is_settled_beside_caustic(const StarCandidate& c, const ImageSearch& search) {
  return c.change < most_change_told && singular_values(c).smaller_square < steepest * steepest &&
         needs_finest(c, search);
}

//! Whether rays of a kind have told of a candidate that is open what they can, and others may tell more.
bool has_told(const StarCandidate& c, const CandidateCourse& course, const ImageSearch& search) {
  switch (course.rays) {
    case RayKind::quick:
      return float_has_told(c, course, search);
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

//! Begins with rays in double from a place that is known in float. Its length is not quite 1, which would be taken for another place: by up to a
//! hundredth of a pixel where the sky is steep.
std::optional<RayKind> begin_in_double(RayKind rays, const Vector3<double>& place, StarCandidate& c,
                                       CandidateCourse& course) {
  c.direction = (1.0 / std::sqrt(dot(place, place))) * place;
  return begin_with(rays, course);
}

//! What comes after rays of a kind.
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

std::optional<RayKind> go_on(StarCandidate& candidate, CandidateCourse& course, const ImageSearch& search) {
  ++course.rounds;
  const double miss = last_miss(course.rays, search.pixel);
  if (is_open(candidate, miss)) {
    if (is_left(candidate, course, search)) {
      candidate.miss = nowhere;
      candidate.faint = true;
    } else if (is_beyond_fold(candidate, course)) {
      candidate.miss = nowhere;
    } else if (is_worth_more(candidate, course, search, miss) && !has_told(candidate, course, search)) {
      course.miss = candidate.miss;
      course.smaller = signed_smaller(candidate);
      return course.rays;
    }
  }
  return next_kind(candidate, course, search);
}

}  // namespace ergodome
