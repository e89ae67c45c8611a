#include "render/passes/stars/refinement/star_refinement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "kernels/launch/check_numbers.h"
#include "render/passes/stars/refinement/candidate_course.h"
#include "render/passes/stars/refinement/candidate_rays.h"
#include "render/passes/stars/refinement/lane_queue.h"

namespace ergodome {

namespace {

std::size_t number_of(RayKind kind) { return static_cast<std::size_t>(kind); }

//! Throws Error if a candidate has a non-finite value.
void check_candidates(const std::vector<StarCandidate>& candidates) {
  for (const StarCandidate& c : candidates) {
    const std::array numbers = {c.direction.x, c.direction.y,     c.direction.z, c.solid_angle,
                                c.stretch,     c.frequency_ratio, c.miss,        c.change};
    require_finite("find_star_images", Backend::cpu, "candidates", numbers.data(), numbers.size());
  }
}

}  // namespace

SingularValues singular_values(const StarCandidate& c) {
  const double root = std::sqrt(std::max(c.stretch * c.stretch - 4.0 * c.solid_angle * c.solid_angle, 0.0));
  const double larger = 0.5 * (c.stretch + root);
  return {larger, larger > 0.0 ? c.solid_angle * c.solid_angle / larger : 0.0};
}

double capped_solid_angle(const StarCandidate& c) {
  return std::max(std::abs(c.solid_angle), 0.5 * c.radius * std::sqrt(singular_values(c).larger_square));
}

SeenImage seen_image(const StarImage& image, const StarCandidate& c) {
  // Next to a caustic an image is an arc; the position of its center need not be more accurate than
  // the length of the arc.
  const double smaller = std::max(singular_values(c).smaller_square, 1e-30);
  const double arc = std::min(c.radius / std::sqrt(smaller), static_cast<double>(longest_arc));
  return {image, static_cast<float>(arc), capped_solid_angle(c) > std::abs(c.solid_angle)};
}

void refine_images(std::vector<StarCandidate>& candidates, const ImageSearch& search) {
  CandidateRays rays(search);
  std::vector<CandidateCourse> courses(candidates.size());
  LaneQueue<ray_kinds> queue({rays.lanes(RayKind::quick), rays.lanes(RayKind::fine), rays.lanes(RayKind::finest)});
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    courses[i].begin = candidates[i].direction;
    queue.add(number_of(RayKind::quick), i);
  }
  queue.run(
      [&](std::size_t kind, std::span<const std::size_t> lot) {
        std::array<StarCandidate*, LaneQueue<ray_kinds>::max_lanes> some{};
        std::ranges::transform(lot, some.begin(), [&](std::size_t i) { return &candidates[i]; });
        rays.follow(static_cast<RayKind>(kind), std::span(some.data(), lot.size()));
      },
      [&](std::size_t i) -> std::optional<std::size_t> {
        const std::optional<RayKind> next = next_ray(candidates[i], courses[i], search);
        return next ? std::optional(number_of(*next)) : std::nullopt;
      });
  if (numbers_are_checked()) {
    check_candidates(candidates);
  }
}

}  // namespace ergodome
