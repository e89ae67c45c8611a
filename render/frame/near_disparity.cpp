#include "render/frame/near_disparity.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "kernels/projection/flat_parallax.h"
#include "render/frame/near_sights.h"

namespace ergodome {

namespace {

//! Puts things into the meter as both eyes see them: eyes at places of their own, or beside a head whose lens they share.
class NearThings {
 public:
  NearThings(const Show& show, const CameraPose& pose, DisparityMeter& meter)
      : flat_(show.stereo.model == StereoModel::flat),
        right_offset_{0.5 * show.stereo.baseline, 0.0, 0.0},
        head_(eye_camera(show, pose, 0.0)),
        left_(show, pose, -1.0),
        right_(show, pose, 1.0),
        meter_(meter) {}

  [[nodiscard]] const EyeCamera& head() const { return head_; }

  void add(const NearSight& sight, const Vector3<double>& view) {
    if (flat_) {
      add_flat(view, sight.distance);
    } else if (sight.first) {
      add_thing({sight.place});
    }
  }

  //! `by_distance`: places of it, in the order of their distance from the head; at least one.
  void add(const PlacedOutline& object, const std::vector<Vector3<double>>& by_distance) {
    for (const Vector3<double>& place : ends_shown(by_distance)) {
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

  //! Of places in the order of their distance the first and the last that the picture shows, if light came straight, and those farthest to all sides: images
  //! stretch things towards their rims. Of none that it shows, the first and the last.
  [[nodiscard]] std::vector<Vector3<double>> ends_shown(const std::vector<Vector3<double>>& places) const {
    struct Shown {
      Vector3<double> place;
      Vector3<double> view;
    };
    std::vector<Shown> shown;
    for (const Vector3<double>& place : places) {
      const Vector3<double> view = straight_view(head_, place);
      if (meter_.shows(view)) {
        shown.push_back({place, view});
      }
    }
    if (shown.empty()) {
      return {places.front(), places.back()};
    }
    const auto [left, right] = std::ranges::minmax_element(shown, {}, [](const Shown& at) { return at.view.x; });
    const auto [low, high] = std::ranges::minmax_element(shown, {}, [](const Shown& at) { return at.view.y; });
    return {shown.front().place, shown.back().place, left->place, right->place, low->place, high->place};
  }

  bool flat_;
  Vector3<double> right_offset_;
  EyeCamera head_;
  StereoEye left_;
  StereoEye right_;
  DisparityMeter& meter_;
};

//! The nearest place of each of an object's triangles, the nearest first. What moves while its light is on the way is about where it is seen.
std::vector<Vector3<double>> places_by_distance(const PlacedOutline& object, const Vector3<double>& from) {
  const auto square = [&](const Vector3<double>& v) { return dot(v, v); };
  const Vector3<double>& middle = object.placement.position;
  const Vector3<double> moved = object.seen(middle, std::sqrt(square(middle - from))) - middle;
  std::vector<Vector3<double>> places;
  const std::span<const Vector3<double>> corners = object.corners;
  for (std::size_t i = 0; i + 3 <= corners.size(); i += 3) {
    places.push_back(nearest_of_triangle(from - moved, std::span<const Vector3<double>, 3>(corners.subspan(i, 3))));
  }
  std::ranges::sort(places, {}, [&](const Vector3<double>& place) { return square(place + moved - from); });
  return places;
}

//! An object and its places.
struct RankedObject {
  const PlacedOutline* object;
  std::vector<Vector3<double>> places;
  double distance;  //!< of the nearest one
};

//! The nearest of the objects that have any places: of many the others stand behind these.
std::vector<RankedObject> nearest_objects(std::span<const PlacedOutline> objects, const Vector3<double>& from) {
  constexpr std::size_t most = 16;
  std::vector<RankedObject> ranked;
  for (const PlacedOutline& object : objects) {
    std::vector<Vector3<double>> places = places_by_distance(object, from);
    if (!places.empty()) {
      const Vector3<double> way = places.front() - from;
      ranked.push_back({&object, std::move(places), std::sqrt(dot(way, way))});
    }
  }
  std::ranges::sort(ranked, {}, &RankedObject::distance);
  ranked.resize(std::min(ranked.size(), most));
  return ranked;
}

}  // namespace

void add_near_things(const Show& show, const CameraPose& pose, const Projection& projection,
                     std::span<const PlacedOutline> objects, DisparityMeter& meter) {
  NearThings things(show, pose, meter);
  if (show.disk || !show.shells.empty()) {
    visit_lattice(projection, [&](const Vector3<double>& view) {
      for (const NearSight& sight : near_sights(show, things.head(), view)) {
        things.add(sight, view);
      }
    });
  }
  for (const RankedObject& ranked : nearest_objects(objects, place_of(things.head()))) {
    things.add(*ranked.object, ranked.places);
  }
}

}  // namespace ergodome
