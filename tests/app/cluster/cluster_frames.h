#pragma once

#include "app/cluster/cluster_messages.h"

namespace ergodome::test {

//! Returns a frame with every optional member, and texts of their maximum length.
inline ClusterFrame full_frame() {
  ClusterFrame frame;
  frame.number = 123'456'789'012ULL;
  frame.epoch = 7;
  frame.time_ns = -1'234'567'890'123LL;
  frame.on_path = true;
  frame.rate = -1.5;
  frame.pose = {12.25, 1.5, -3.0, glm::dquat(0.5, -0.5, 0.5, -0.5), Vector3<double>{0.1, -0.2, 0.3}, true, -17.5};
  frame.before = LensPosition{12.5, 1.25};
  frame.motion = ObserverMotion::velocity;
  frame.velocity = {0.5, 0.25, -0.125};
  frame.mode = ViewMode::magnification;
  frame.field_of_view_deg = 180.0;
  frame.stereo.layout = StereoLayout::separate;
  frame.stereo.model = StereoModel::omni;
  frame.stereo.baseline = 0.25;
  frame.stereo.swap_eyes = true;
  frame.exposure_stops = -2.5;
  frame.followed_stops = 1.25;
  frame.language = std::string(max_cluster_name, 'x');
  frame.captions = false;
  frame.size_px = 4096;
  frame.projectors_px = 5000;
  frame.quality = ClusterQuality{0.5, 2, SkyFilter::point, 2048};
  frame.attract = true;
  frame.texts_opacity = 0.75;
  frame.texts = 3;
  frame.pattern = ClusterPattern::test_pattern;
  frame.pattern_kind = 4;
  frame.calibration = 5;
  return frame;
}

//! Returns captions of two lines.
inline ClusterTexts some_texts() {
  Caption caption;
  caption.position = {10.0, -20.0, 30.0};
  caption.color = {0.5, 0.25, 0.0};
  caption.text = {{"", "Welcome\nto the hole"}};
  return {4, {caption, Caption()}};
}

//! Returns a calibration of two projectors.
inline ClusterCalibration some_calibration() {
  GridOffsets offsets = GridOffsets().resized(3);
  offsets.move(4, 0.01, -0.02);
  return {6, "[dome]\nradius_m = 5\n", {GridOffsets(), offsets}, {"1: north", ""}};
}

//! Returns a frame with a plain pose on the path of a show.
inline ClusterFrame plain_frame(std::int64_t time_ns = 0) {
  ClusterFrame frame;
  frame.time_ns = time_ns;
  frame.on_path = true;
  frame.rate = 1.0;
  frame.pose.r = 20.0;
  frame.pose.theta = 1.5;
  frame.pose.orientation = glm::dquat(1.0, 0.0, 0.0, 0.0);
  frame.size_px = 64;
  return frame;
}

}  // namespace ergodome::test
