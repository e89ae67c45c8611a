#include "render/stereo/near_disparity.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "content/show/stereo_eyes.h"
#include "kernels/eyes/flat/eye_line.h"
#include "kernels/launch/parallel_for.h"

namespace ergodome {

namespace {

//! Adds things to a disparity meter as both eyes see them. The eyes have cameras at their own
//! positions or, in the model `flat`, are beside a head whose lens they use.
class NearThings {
 public:
  NearThings(const Show& show, const CameraPose& pose, DisparityMeter& meter)
      : flat_(eye_cameras(show.stereo.model) == EyeCameras::shared),
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
      add_thing({sight.position});
    }
  }

  //! Adds an object. `by_distance`: some of its points, at least one, ordered by distance from the
  //! head.
  void add(const PlacedOutline& object, const std::vector<Vector3<double>>& by_distance) {
    for (const Vector3<double>& position : ends_shown(by_distance)) {
      const SeenThing thing = {position, &object};
      if (!flat_) {
        add_thing(thing);
      } else if (const auto seen = seen_by_camera(head_, thing)) {
        if (const auto distance = distance_of_position(head_, seen->view, seen->position)) {
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

  //! Selects some of the points `positions`, which are ordered by distance: of those that the
  //! picture would show if light traveled straight, the first, the last, and the outermost to the
  //! left, right, top and bottom, because an object's lensed image is stretched most there. If the
  //! picture would show none, selects the first and the last point of all.
  [[nodiscard]] std::vector<Vector3<double>> ends_shown(const std::vector<Vector3<double>>& positions) const {
    struct Shown {
      Vector3<double> position;
      Vector3<double> view;
    };
    std::vector<Shown> shown;
    for (const Vector3<double>& position : positions) {
      const Vector3<double> view = straight_view(head_, position);
      if (meter_.shows(view)) {
        shown.push_back({position, view});
      }
    }
    if (shown.empty()) {
      return {positions.front(), positions.back()};
    }
    const auto [left, right] = std::ranges::minmax_element(shown, {}, [](const Shown& at) { return at.view.x; });
    const auto [low, high] = std::ranges::minmax_element(shown, {}, [](const Shown& at) { return at.view.y; });
    return {shown.front().position, shown.back().position, left->position,
            right->position,        low->position,         high->position};
  }

  bool flat_;
  Vector3<double> right_offset_;
  EyeCamera head_;
  StereoEye left_;
  StereoEye right_;
  DisparityMeter& meter_;
};

//! An object and some of its points, ordered by distance.
struct RankedObject {
  const PlacedOutline* object;
  //! The nearest point of each of the object's triangles, ordered by distance from the head.
  std::vector<Vector3<double>> positions;
  double square;  //!< squared distance of the nearest point
};

//! Orders an object's points by distance. The object is taken approximately where it is seen,
//! because it may move while its light travels.
RankedObject ranked(const PlacedOutline& object, const Vector3<double>& from) {
  const auto square = [](const Vector3<double>& v) { return dot(v, v); };
  const Vector3<double>& middle = object.placement.position;
  const Vector3<double> moved = object.seen(middle, std::sqrt(square(middle - from))) - middle;
  RankedObject it{&object, {}, std::numeric_limits<double>::infinity()};
  const std::span<const Vector3<double>> corners = object.corners;
  for (std::size_t i = 0; i + 3 <= corners.size(); i += 3) {
    it.positions.push_back(
        nearest_of_triangle(from - moved, std::span<const Vector3<double>, 3>(corners.subspan(i, 3))));
  }
  std::ranges::sort(it.positions, {}, [&](const Vector3<double>& position) { return square(position + moved - from); });
  if (!it.positions.empty()) {
    it.square = square(it.positions.front() + moved - from);
  }
  return it;
}

//! Returns the sixteen nearest of the objects that have any points, nearest first. Disparities of
//! other objects are not measured.
std::vector<RankedObject> nearest_objects(std::span<const PlacedOutline> objects, const Vector3<double>& from) {
  constexpr std::size_t maximum = 16;
  std::vector<RankedObject> nearest;
  for (const PlacedOutline& object : objects) {
    RankedObject it = ranked(object, from);
    if (!it.positions.empty()) {
      nearest.push_back(std::move(it));
    }
  }
  std::ranges::sort(nearest, {}, &RankedObject::square);
  nearest.resize(std::min(nearest.size(), maximum));
  return nearest;
}

//! Finds the points of disk and shells that a head sees in a direction, without those behind an
//! object of `hiding`, and whether it sees such an object; stores both in `direction`.
void find_sights(const Show& show, const EyeCamera& head, const PlacedMeshes& hiding, SeenDirection& direction) {
  direction.sights = near_sights(show, head, direction.view);
  if (hiding.meshes.empty()) {
    return;
  }
  const double distance = distance_of_objects(hiding, head, direction.view);
  const auto behind = std::ranges::upper_bound(direction.sights, distance, {}, &NearSight::distance);
  direction.ends_at_object = std::isfinite(distance);
  direction.sights.erase(behind, direction.sights.end());
}

}  // namespace

bool is_black(const SkySettings& sky) { return sky.stars.empty() && (sky.map == "black" || sky.exposure == 0.0); }

std::vector<SeenDirection> seen_directions(const Show& show, const CameraPose& pose, const Projection& projection,
                                           const PlacedMeshes& hiding) {
  std::vector<SeenDirection> directions;
  if (!is_black(show.sky)) {
    visit_many(projection, [&](const Vector3<double>& view) { directions.push_back({view, DisparityOf::sky, {}}); });
  }
  visit_lattice(projection, [&](const Vector3<double>& view) {
    directions.push_back({view, DisparityOf::disk_and_shells, {}});
  });
  if (show.disk || !show.shells.empty() || !hiding.meshes.empty()) {
    const EyeCamera head = eye_camera(show, pose, 0.0);
    parallel_for(static_cast<int>(directions.size()), 4, [&](int begin, int end) {
      for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
        find_sights(show, head, hiding, directions[i]);
      }
    });
  }
  return directions;
}

void add_near_things(const Show& show, const CameraPose& pose, std::span<const SeenDirection> directions,
                     std::span<const PlacedOutline> objects, DisparityMeter& meter) {
  NearThings things(show, pose, meter);
  for (const SeenDirection& direction : directions) {
    if (direction.disparity_of != DisparityOf::disk_and_shells) {
      continue;
    }
    for (const NearSight& sight : direction.sights) {
      things.add(sight, direction.view);
    }
  }
  for (const RankedObject& near : nearest_objects(objects, position_of(things.head()))) {
    things.add(*near.object, near.positions);
  }
}

}  // namespace ergodome
