#include "render/passes/stars/drawing/star_trails.h"

#include <cmath>

#include "kernels/launch/work_counter.h"
#include "render/passes/stars/refinement/star_refinement.h"

namespace ergodome {

namespace {

//! Maximum angle by which an image moves in one step, or differs from its extrapolated position
//! [rad]. A larger one means that it is a different image.
constexpr double farthest_step = 0.2;
//! Value used for the distance to the shadow's edge, which is not known here [rad]. It causes one
//! more round of refinement where the lens map may change quickly.
constexpr double cautious_distance = 0.1;

Vector3<double> widened(const Vector3<float>& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

//! Follows all images forward or backward in time through the eyes of a shutter.
class Follower {
 public:
  Follower(const std::vector<StarImage>& images, const StarField& field, double pixel, StarTrails& trails)
      : images_(images), field_(field), pixel_(pixel), trails_(trails) {
    alive_.resize(images.size());
    for (std::size_t i = 0; i < images.size(); ++i) {
      alive_[i] = i;
    }
  }

  //! Steps from eye `from` to the adjacent eye `to`; `eye` is the latter.
  void step(const StarEye& eye, int from, int to) {
    std::vector<StarCandidate> candidates;
    candidates.reserve(alive_.size());
    for (const std::size_t i : alive_) {
      candidates.push_back(candidate(eye, i, from, to));
    }
    const std::vector<StarCandidate> expected = candidates;
    refine_images(candidates, {eye, {}, pixel_, {}, [](const StarCandidate&) { return true; }});
    std::vector<std::size_t> still;
    for (std::size_t k = 0; k < alive_.size(); ++k) {
      const StarCandidate& c = candidates[k];
      const std::size_t i = alive_[k];
      const Vector3<double> off = c.direction - expected[k].direction;
      const bool same_side = (c.solid_angle < 0.0) == (images_[i].magnification < 0.0F);
      if (c.miss <= image_tolerance_px * pixel_ && same_side && dot(off, off) < farthest_step * farthest_step) {
        position(i, to) = {static_cast<float>(c.direction.x), static_cast<float>(c.direction.y),
                           static_cast<float>(c.direction.z)};
        (to < from ? trails_.ways[i].first : trails_.ways[i].last) = to;
        still.push_back(i);
      }
    }
    alive_ = std::move(still);
  }

 private:
  Vector3<float>& position(std::size_t image, int at) {
    return trails_.directions[image * static_cast<std::size_t>(trails_.positions) + static_cast<std::size_t>(at)];
  }

  //! Returns a candidate for the image at eye `to`, extrapolated from the image's motion so far.
  StarCandidate candidate(const StarEye& eye, std::size_t i, int from, int to) {
    const FieldStar& star = field_.stars()[static_cast<std::size_t>(images_[i].star)];
    const Vector3<double>& d = star.direction;
    const double sine = std::sin(eye.camera.phi);
    const double cosine = std::cos(eye.camera.phi);
    const int before = 2 * from - to;
    const bool has_way = before >= trails_.ways[i].first && before <= trails_.ways[i].last;
    Vector3<double> there = widened(position(i, from));
    if (has_way) {
      there = 2.0 * there - widened(position(i, before));
      there = (1.0 / std::sqrt(dot(there, there))) * there;
    }
    StarCandidate c;
    c.star = images_[i].star;
    c.on_sky = {cosine * d.x + sine * d.y, cosine * d.y - sine * d.x, d.z};
    c.direction = there;
    c.radius = static_cast<double>(star.radius);
    c.edge_distance = cautious_distance;
    return c;
  }

  const std::vector<StarImage>& images_;
  const StarField& field_;
  double pixel_;
  StarTrails& trails_;
  std::vector<std::size_t> alive_;
};

}  // namespace

StarTrails star_trails(const std::vector<StarImage>& images, const StarField& field, const Shutter& shutter,
                       double pixel) {
  static WorkCounter counter("follow_trails");
  const WorkScope work(counter, static_cast<long>(images.size()));
  StarTrails trails;
  trails.positions = static_cast<int>(shutter.eyes.size());
  trails.directions.resize(images.size() * shutter.eyes.size());
  const int middle = trails.positions / 2;
  for (std::size_t i = 0; i < images.size(); ++i) {
    trails.ways.push_back({middle, middle, images[i].illuminance});
    trails.directions[i * shutter.eyes.size() + static_cast<std::size_t>(middle)] = images[i].direction;
  }
  Follower back(images, field, pixel, trails);
  for (int at = middle; at > 0; --at) {
    back.step(shutter.eyes[static_cast<std::size_t>(at - 1)], at, at - 1);
  }
  Follower on(images, field, pixel, trails);
  for (int at = middle; at + 1 < trails.positions; ++at) {
    on.step(shutter.eyes[static_cast<std::size_t>(at) + 1U], at, at + 1);
  }
  return trails;
}

}  // namespace ergodome
