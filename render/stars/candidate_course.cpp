#include "render/stars/candidate_course.h"

#include <algorithm>
#include <cmath>

#include "render/stars/edge_rounding.h"

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
constexpr int most_rounds = 24;
//! What is farther than this after the first rounds is on no way: it leaps about, in distances to the shadow's edge.
constexpr double lost_miss = 2.0;
//! Larger misses say that no light came [rad].
constexpr double no_light = 1e29;
constexpr double nowhere = 1e30;
//! What goes farther than this after the rounds of those on their way will not come to an end, as a part of the distance to the shadow's
//! edge.
constexpr double hopeless_miss = 0.02;
//! Larger changes of the magnification over a step are but told as large.
constexpr double most_change_told = 0.5;

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
bool is_worth_more(const StarCandidate& c, const CandidateCourse& course, double miss) {
  if (course.rounds < first_rounds) {
    return true;
  }
  if (course.rounds == first_rounds) {
    return !is_lost(c);
  }
  if (course.rounds < on_way_rounds) {
    return true;
  }
  const bool is_near = c.miss > miss && c.miss < hopeless_miss * c.edge_distance;
  return course.rays != RayKind::quick && course.rounds < most_rounds && (course.rounds > on_way_rounds || is_near);
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
  const double pixel = search.pixel;
  const SingularValues values = singular_values(c);
  const double smaller = std::min(std::sqrt(values.smaller_square), 1.0);
  if (float_tells(c, search) && (is_lost(c) || c.miss * smaller > near_px * pixel)) {
    return Start::none;
  }
  if (!(c.miss <= image_tolerance_px * pixel) || values.smaller_square < steepest * steepest) {
    return Start::rough;
  }
  // The map changes on the scale of the distance to the shadow's edge, and next to a caustic faster by one over the square of its smaller
  // singular value.
  const double change = edge_rounding / (c.edge_distance * std::min(values.smaller_square, 1.0));
  return change > most_change ? Start::found : Start::none;
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

std::optional<RayKind> begin_with(RayKind rays, CandidateCourse& course) {
  course.rays = rays;
  course.rounds = 0;
  return rays;
}

//! What comes after rays of a kind.
std::optional<RayKind> next_kind(StarCandidate& c, CandidateCourse& course, const ImageSearch& search) {
  if (course.rays == RayKind::quick) {
    switch (double_start(c, search)) {
      case Start::none:
        return std::nullopt;
      case Start::found:
        return search.wanted(c) ? begin_with(RayKind::fine, course) : std::nullopt;
      case Start::rough:
        c.direction = course.begin;
        course.led_away = true;
        return begin_with(RayKind::fine, course);
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
    } else if (is_worth_more(candidate, course, miss)) {
      return course.rays;
    }
  }
  return next_kind(candidate, course, search);
}

}  // namespace ergodome
