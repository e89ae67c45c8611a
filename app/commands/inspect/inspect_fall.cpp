#include "app/commands/inspect/inspect_fall.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "content/camera/camera_path.h"
#include "content/camera/rain_pose.h"
#include "content/files/console.h"
#include "content/files/printable.h"
#include "kernels/core/angles.h"

namespace ergodome {

namespace {

using nlohmann::json;

constexpr std::size_t max_turns_printed = 24;

//! Returns the camera's speed [c] relative to the ZAMO; inside the horizon, where there is no ZAMO,
//! relative to the rain frame.
double speed_at(const Show& show, double time_s) {
  const CameraPose pose = in_zamo_frame(camera_pose(show, time_s), spacetime_of(show));
  const Vector3<double> v = pose.velocity.value_or(Vector3<double>{});
  return std::sqrt(dot(v, v));
}

}  // namespace

json summary_of_fall(const Show& show) {
  constexpr const char* kinds[] = {"nearest", "farthest", "northernmost", "southernmost"};
  const FreeFall& orbit = *show.camera.orbit;
  const double begin_s = orbit.begin_s();
  const double end_s = orbit.until_s().value_or(show.duration_s);
  const FallPosition end = orbit.at(end_s);
  json summary = {{"t_s", begin_s},
                  {"until_s", end_s},
                  {"beta", speed_at(show, begin_s)},
                  {"own_time", orbit.proper_time(end_s)},
                  {"rounds", orbit.swept_angle(end_s) / (2.0 * pi)},
                  {"end", {{"r", end.r}, {"theta_deg", end.theta * radian_deg}, {"beta", speed_at(show, end_s)}}},
                  {"turns", json::array()}};
  double least_r = std::min(orbit.start().r, end.r);
  for (const FallTurn& turn : orbit.turns()) {
    if (turn.time_s <= end_s) {
      least_r = std::min(least_r, turn.r);
      summary["turns"].push_back({{"kind", kinds[static_cast<int>(turn.kind)]},
                                  {"t_s", turn.time_s},
                                  {"r", turn.r},
                                  {"theta_deg", turn.theta * radian_deg},
                                  {"beta", speed_at(show, turn.time_s)}});
    }
  }
  summary["least_r"] = least_r;
  if (orbit.leads_within() && orbit.horizon_s() && *orbit.horizon_s() <= end_s) {
    const FallPosition position = orbit.at(*orbit.horizon_s());
    summary["horizon"] = {
        {"t_s", *orbit.horizon_s()}, {"r", position.r}, {"theta_deg", position.theta * radian_deg}, {"beta", 1.0}};
  }
  if (orbit.stop_s() && *orbit.stop_s() <= end_s) {
    summary["stop_s"] = *orbit.stop_s();
  }
  return summary;
}

void print_fall(const json& summary) {
  print_out(
      "\nfree fall from {:.3f} s to {:.3f} s: initial speed {:.4f} c, proper time {:.6g} M, {:.2f} turns around the "
      "hole, smallest radius {:.6g} M\n",
      summary["t_s"].get<double>(), summary["until_s"].get<double>(), summary["beta"].get<double>(),
      summary["own_time"].get<double>(), summary["rounds"].get<double>(), summary["least_r"].get<double>());
  const auto line = [](double time_s, const json& at, const std::string& what) {
    print_out("{:>10.3f} {:>12.6g} {:>12.4f} {:>10.4f}  {}\n", time_s, at["r"].get<double>(),
              at["theta_deg"].get<double>(), at["beta"].get<double>(), what);
  };
  if (summary["turns"].empty() && !summary.contains("stop_s") && !summary.contains("horizon")) {
    return;
  }
  print_out("{:>10} {:>12} {:>12} {:>10}\n", "t [s]", "r [M]", "theta [deg]", "speed [c]");
  const double crossing_s = summary.contains("horizon") ? summary["horizon"]["t_s"].get<double>() : INFINITY;
  bool crosses = summary.contains("horizon");
  const auto cross_before = [&](double time_s) {
    if (crosses && crossing_s < time_s) {
      line(crossing_s, summary["horizon"], "crosses the horizon; from here on, speeds are relative to the rain frame");
      crosses = false;
    }
  };
  std::size_t printed = 0;
  for (const json& turn : summary["turns"]) {
    const auto time_s = turn["t_s"].get<double>();
    cross_before(time_s);
    if (++printed > max_turns_printed) {
      print_out("and {} more\n", counted(summary["turns"].size() - max_turns_printed, "turning point"));
      break;
    }
    line(time_s, turn, turn["kind"].get<std::string>());
  }
  cross_before(INFINITY);
  if (summary.contains("stop_s")) {
    line(summary["stop_s"].get<double>(), summary["end"], "the fall stops: its clock is at rest");
  }
}

}  // namespace ergodome
