#include "render/frame/near_disparity.h"

#include <algorithm>
#include <cmath>

#include "kernels/projection/flat_parallax.h"
#include "render/frame/near_sights.h"

namespace ergodome {

namespace {

//! The same things for either kind of eyes.
class NearThings {
 public:
  NearThings(const Show& show, const CameraPose& pose, DisparityMeter& meter)
      : flat_(show.stereo.model == StereoModel::flat),
        right_offset_{0.5 * show.stereo.baseline, 0.0, 0.0},
        head_(eye_camera(show, pose, 0.0)),
        left_(show, pose, -1.0),
        right_(show, pose, 1.0),
        meter_(meter) {}

  void add(const NearSight& sight, const Vector3<double>& view) {
    if (flat_) {
      add_flat(view, sight.distance);
    } else if (sight.first) {
      add_thing({sight.place});
    }
  }

  void add(const PlacedOutline& object) {
    for (const Vector3<double>& place : ends_of(object)) {
      const SeenThing thing = {place, &object};
      if (!flat_) {
        add_thing(thing);
      } else if (const auto seen = seen_by_camera(head_, thing)) {
        if (const auto distance = distance_of_place(head_, seen->view, seen->place)) {
          add_flat(seen->view, *distance);
        }
      }
    }
  }

 private:
  void add_flat(const Vector3<double>& view, double distance) {
    meter_.add(seen_by_eye(view, distance, -1.0 * right_offset_), seen_by_eye(view, distance, right_offset_));
  }

  void add_thing(const SeenThing& thing) {
    const auto left = left_.sees(thing);
    const auto right = right_.sees(thing);
    if (left && right) {
      meter_.add(*left, *right);
    }
  }

  //! Some places of an object that are nearest to the head, and one that is farthest.
  [[nodiscard]] std::vector<Vector3<double>> ends_of(const PlacedOutline& object) const {
    constexpr std::size_t nearest = 3;
    const double sine = std::sin(head_.theta);
    const Vector3<double> at = {head_.r * sine * std::cos(head_.phi), head_.r * sine * std::sin(head_.phi),
                                head_.r * std::cos(head_.theta)};
    std::vector<Vector3<double>> ends = object.places;
    const auto way = [&](const Vector3<double>& place) { return dot(place - at, place - at); };
    std::ranges::sort(ends, {}, way);
    if (ends.size() > nearest + 1) {
      ends.erase(ends.begin() + nearest, ends.end() - 1);
    }
    return ends;
  }

  bool flat_;
  Vector3<double> right_offset_;
  EyeCamera head_;
  StereoEye left_;
  StereoEye right_;
  DisparityMeter& meter_;
};

}  // namespace

void add_near_things(const Show& show, const CameraPose& pose, const Projection& projection,
                     std::span<const PlacedOutline> objects, DisparityMeter& meter) {
  NearThings things(show, pose, meter);
  if (show.disk || !show.shells.empty()) {
    const EyeCamera head = eye_camera(show, pose, 0.0);
    visit_lattice(projection, [&](const Vector3<double>& view) {
      for (const NearSight& sight : near_sights(show, head, view)) {
        things.add(sight, view);
      }
    });
  }
  for (const PlacedOutline& object : objects) {
    things.add(object);
  }
}

}  // namespace ergodome
