#include "render/stars/star_refinement.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "kernels/launch/launch.h"
#include "kernels/launch/parallel_for.h"
#include "render/stars/edge_rounding.h"

namespace ergodome {

namespace {

//! Errors of rays in double on the sky, as float_tolerance is of those in float, and next to caustics; images move by that over the smaller
//! singular value of the map.
constexpr double fine_tolerance = 1e-9;
constexpr double finest_tolerance = 1e-11;
//! What an image may be off by where the magnification changes fast [rad].
constexpr double fine_miss = 1e-7;
//! And next to a caustic, where a hair beside a ring the magnification is another [rad].
constexpr double ring_tolerance = 1e-10;
//! Smaller singular value of the map to the sky below which float's rounding is seen in an image's place.
constexpr double steepest = 0.1;
//! Change of the magnification that float's rounding may make, as a part of it.
constexpr double most_change = 0.01;
//! What rays have not brought so near to an image has none [px]; next to a caustic, where images run along it, so near to the star.
constexpr double near_px = 2.0;
//! Nearer to the shadow's edge rays in float tell neither that, nor that an image is too faint: next to a caustic some lead astray [rad].
constexpr double least_float_distance = 1e-3;
constexpr int star_step_limit = 400;
//! Rounds of rays after the first in which most images are found, those left put together anew before each.
constexpr int later_rounds = 3;
//! And the last ones, for those that are on their way.
constexpr int last_rounds = 2;
//! And in which those are that lie next to caustics, far from where they are sought.
constexpr int many_rounds = 18;
//! What is farther than this after the later rounds is on no way: it leaps about, in distances to the shadow's edge.
constexpr double lost_miss = 2.0;
//! Larger misses say that no light came [rad].
constexpr double no_light = 1e29;
constexpr double nowhere = 1e30;
//! What goes farther than this after the few rounds will not come to an end, as a part of the distance to the shadow's edge.
constexpr double hopeless_miss = 0.02;

//! How exact rays are, and how near an image has to be for the last step [rad].
struct RayPrecision {
  double tolerance;
  double miss;
};

//! Finds images exactly, as far as rays in S are exact.
template <class S, class Camera>
void refine_by(const Camera& camera, const StarChartOf<double>& chart, std::vector<StarCandidate>& candidates,
               const RayPrecision& precision, int rounds) {
  constexpr std::size_t channels = 13;
  const std::size_t count = candidates.size();
  std::vector<S> values(channels * count);
  const auto channel = [&](std::size_t i) { return values.data() + i * count; };
  const auto each = [&](const auto& work) {
    parallel_for(static_cast<int>(count), 4096, [&](int begin, int end) {
      for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
        work(i);
      }
    });
  };
  each([&](std::size_t i) {
    const StarCandidate& c = candidates[i];
    const double parts[8] = {c.on_sky.x,    c.on_sky.y,    c.on_sky.z,      c.direction.x,
                             c.direction.y, c.direction.z, c.edge_distance, c.radius};
    for (std::size_t part = 0; part < 8; ++part) {
      channel(part)[i] = static_cast<S>(parts[part]);
    }
  });
  const StarImageBatch<S, Camera> batch = {camera,
                                           {chart.chart, converted_aberration<S>(chart.aberration)},
                                           {precision.tolerance, star_step_limit, true},
                                           static_cast<S>(precision.miss),
                                           rounds,
                                           static_cast<int>(count),
                                           {channel(0), channel(1), channel(2)},
                                           channel(6),
                                           channel(7),
                                           {channel(3), channel(4), channel(5)},
                                           channel(8),
                                           channel(9),
                                           channel(10),
                                           channel(11),
                                           channel(12)};
  find_star_images(batch);
  each([&](std::size_t i) {
    StarCandidate& c = candidates[i];
    const auto at = [&](std::size_t part) { return static_cast<double>(channel(part)[i]); };
    c.direction = {at(3), at(4), at(5)};
    c.solid_angle = at(8);
    c.stretch = at(9);
    c.frequency_ratio = at(10);
    c.miss = at(11);
    c.change = at(12);
  });
}

OmniCameraOf<float> omni_cameras(const OmniEye& eye, float /*precision*/) { return eye.cameras->on_host(eye.side); }
OmniCameraOf<double> omni_cameras(const OmniEye& eye, double /*precision*/) { return eye.cameras->exact(eye.side); }

template <class S>
void refine(std::vector<StarCandidate>& candidates, const ImageSearch& search, const RayPrecision& precision,
            int rounds) {
  const StarEye& eye = search.eye;
  if (eye.omni) {
    return refine_by<S>(omni_cameras(*eye.omni, S{}), search.chart, candidates, precision, rounds);
  }
  const EyeCamera& c = eye.camera;
  refine_by<S>(converted_station<S>(make_camera_station(c.spin, c.r, c.theta, 0.0, c.motion, c.velocity)), search.chart,
               candidates, precision, rounds);
}

//! Does `work` with those candidates that are `chosen`, put together: lanes wait for one another.
template <class Chosen, class Work>
void with_some(std::vector<StarCandidate>& candidates, const Chosen& chosen, const Work& work) {
  std::vector<std::size_t> places;
  std::vector<StarCandidate> some;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (chosen(candidates[i])) {
      places.push_back(i);
      some.push_back(candidates[i]);
    }
  }
  work(some);
  for (std::size_t i = 0; i < places.size(); ++i) {
    candidates[places[i]] = some[i];
  }
}

//! Whether another round would tell more of an image.
bool is_open(const StarCandidate& c, const RayPrecision& precision) {
  return (c.miss > precision.miss || c.change > most_magnification_change) && c.miss < no_light;
}

//! Whether rounds have led an image nowhere.
bool is_lost(const StarCandidate& c) { return c.miss > lost_miss * c.edge_distance; }

//! Larger changes of the magnification over a step are but told as large.
constexpr double most_change_told = 0.5;

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

//! Leaves those images that stay faint and of which `asked` says so.
template <class Asked>
void leave_faint(std::vector<StarCandidate>& candidates, const ImageSearch& search, const RayPrecision& precision,
                 const Asked& asked) {
  if (!search.brightness) {
    return;
  }
  for (StarCandidate& c : candidates) {
    if (is_open(c, precision) && asked(c) && stays_faint(c, search)) {
      c.miss = nowhere;
      c.faint = true;
    }
  }
}

//! Seeks images, most of which one ray finds: the others shall not keep them waiting, nor those that never end each other.
template <class S>
void refine_together(std::vector<StarCandidate>& candidates, const ImageSearch& search, const RayPrecision& precision) {
  const auto tells = [&](const StarCandidate& c) { return std::is_same_v<S, double> || float_tells(c, search); };
  refine<S>(candidates, search, precision, 1);
  leave_faint(candidates, search, precision, tells);
  const auto refine_open = [&](int rounds, const auto& chosen) {
    with_some(
        candidates, [&](const StarCandidate& c) { return is_open(c, precision) && chosen(c); },
        [&](std::vector<StarCandidate>& open) { refine<S>(open, search, precision, rounds); });
  };
  for (int round = 0; round < later_rounds; ++round) {
    refine_open(1, [](const StarCandidate&) { return true; });
    leave_faint(candidates, search, precision,
                [&](const StarCandidate& c) { return c.change >= most_change_told && tells(c); });
  }
  refine_open(last_rounds, [](const StarCandidate& c) { return !is_lost(c); });
}

//! Seeks images in double, and patiently those that the few rounds have brought near but not to the end.
void refine_patiently(std::vector<StarCandidate>& candidates, const ImageSearch& search,
                      const RayPrecision& precision) {
  refine_together<double>(candidates, search, precision);
  with_some(
      candidates,
      [&](const StarCandidate& c) { return c.miss > precision.miss && c.miss < hopeless_miss * c.edge_distance; },
      [&](std::vector<StarCandidate>& near) { refine<double>(near, search, precision, many_rounds); });
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

//! Follows images next to caustics to the end. Most of what is sought there is none: only what came near is worth rays that cost more.
void refine_finest(std::vector<StarCandidate>& candidates, const ImageSearch& search) {
  const auto is_beside_caustic = [&](const StarCandidate& c) {
    return c.miss > fine_miss || singular_values(c).smaller_square < steepest * steepest;
  };
  // A hair beside where it is found, an image is about as bright.
  const auto is_faint = [&](const StarCandidate& c) {
    constexpr double hair = 0.05;
    constexpr double slack = 4.0;
    return search.brightness && c.miss < hair * c.edge_distance && search.brightness(c) * slack < 1.0;
  };
  with_some(
      candidates,
      [&](const StarCandidate& c) { return c.miss <= near_px * search.pixel && is_beside_caustic(c) && !is_faint(c); },
      [&](std::vector<StarCandidate>& near) {
        refine_patiently(near, search, {finest_tolerance, std::min(image_tolerance_px * search.pixel, ring_tolerance)});
      });
}

//! Seeks in double what float's rounding leaves wrong.
void refine_steep(std::vector<StarCandidate>& candidates, const std::vector<StarCandidate>& rough,
                  const ImageSearch& search, const std::function<bool(const StarCandidate&)>& wanted) {
  std::vector<std::size_t> places;
  std::vector<StarCandidate> steep;
  const auto take = [&](Start start) {
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      if (double_start(candidates[i], search) == start && (start == Start::rough || wanted(candidates[i]))) {
        places.push_back(i);
        steep.push_back(start == Start::found ? candidates[i] : rough[i]);
      }
    }
  };
  take(Start::found);
  const auto found = static_cast<std::ptrdiff_t>(steep.size());
  take(Start::rough);
  const double miss = image_tolerance_px * search.pixel;
  refine_patiently(steep, search, {fine_tolerance, std::min(miss, fine_miss)});
  std::vector<StarCandidate> from_rough(steep.begin() + found, steep.end());
  refine_finest(from_rough, search);
  std::ranges::copy(from_rough, steep.begin() + found);
  for (std::size_t i = 0; i < places.size(); ++i) {
    candidates[places[i]] = steep[i];
  }
}

}  // namespace

SingularValues singular_values(const StarCandidate& c) {
  const double root = std::sqrt(std::max(c.stretch * c.stretch - 4.0 * c.solid_angle * c.solid_angle, 0.0));
  const double larger = 0.5 * (c.stretch + root);
  return {larger, larger > 0.0 ? c.solid_angle * c.solid_angle / larger : 0.0};
}

void refine_images(std::vector<StarCandidate>& candidates, const ImageSearch& search,
                   const std::function<bool(const StarCandidate&)>& wanted) {
  const std::vector<StarCandidate> rough = candidates;
  refine_together<float>(candidates, search, {float_tolerance, image_tolerance_px * search.pixel});
  refine_steep(candidates, rough, search, wanted);
}

}  // namespace ergodome
