#include "render/present/headset/frame_motion.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ergodome {

namespace {

//! A step between frames counts as a jump if it is both longer than this part of the distance to
//! the hole and faster than any flight [distances/s].
constexpr double longest_step = 0.05;
constexpr double fastest_flight = 3.0;
//! Without a new frame for this time, the observer is at rest.
constexpr double rest_after_s = 0.5;

Vector3<double> position_of_pose(const CameraPose& pose) {
  return {pose.r * std::sin(pose.theta) * std::cos(pose.phi), pose.r * std::sin(pose.theta) * std::sin(pose.phi),
          pose.r * std::cos(pose.theta)};
}

}  // namespace

void FrameMotion::note(const OutputFrame& frame, double now_s) {
  const Noted now{position_of_pose(frame.observer), frame.observer.r, now_s};
  if (last_ && now_s > last_->time_s) {
    const Vector3<double> way = now.position - last_->position;
    const double step = std::sqrt(dot(way, way)) / std::max(std::min(now.r, last_->r), 1e-9);
    const double rate = step / (now_s - last_->time_s);
    const bool jumped = step > longest_step && rate > fastest_flight;
    cut_ = cut_ || jumped;
    speed_ = jumped ? 0.0 : rate;
  }
  last_ = now;
}

double FrameMotion::speed(double now_s) const { return last_ && now_s - last_->time_s < rest_after_s ? speed_ : 0.0; }

bool FrameMotion::take_cut() { return std::exchange(cut_, false); }

}  // namespace ergodome
