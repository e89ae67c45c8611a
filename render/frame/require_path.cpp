#include "render/frame/require_path.h"

#include <cmath>

#include "content/camera/camera_path.h"
#include "content/show/animated_show.h"
#include "kernels/core/error.h"

namespace ergodome {

void require_path_of(const Show& show, const TrajectoryReader& trajectory) {
  const auto other = [&](const char* what) {
    return Error(trajectory.path().string(), std::string("was baked for another ") + what, "bake the show again");
  };
  if (find_animation(show, "hole.spin") != nullptr) {
    throw Error(trajectory.path().string(), "was baked for one spin, but the show's spin changes with time",
                "remove the trajectory; each frame then gets its own lens");
  }
  if (trajectory.provenance().spacetime != spacetime_of(show)) {
    throw other("spin");
  }
  // Tolerates rounding differences between machines, which grow over long orbits.
  constexpr double rounding = 1e-9;
  const auto same = [](double a, double b) { return std::abs(a - b) <= rounding * std::abs(a); };
  for (const StationEntry& station : trajectory.stations()) {
    const CameraPose pose = camera_pose(show, station.time_s);
    if (!same(pose.r, station.r) || std::abs(pose.theta - station.theta) > rounding) {
      throw other("camera path");
    }
  }
  if (!same(trajectory.stations().back().time_s, show.duration_s)) {
    throw other("duration");
  }
}

}  // namespace ergodome
