#include "app/exhibit/exhibit.h"

#include <algorithm>

namespace ergodome {

namespace {

//! Duration of the countdown at the end of a session.
constexpr double farewell_s = 20.0;
constexpr double fade_s = 1.0;

}  // namespace

bool Exhibit::advance(double now_s, bool touched) {
  now_s_ = std::max(now_s, now_s_);
  if (touched) {
    touched_s_ = now_s_;
  }
  if (scene_ == ExhibitScene::attract) {
    const bool resting = session_over_ && now_s_ - began_s_ < times_.rest_s;
    if (!touched || resting) {
      return false;
    }
    scene_ = ExhibitScene::visitor;
  } else {
    session_over_ = times_.session_s > 0.0 && now_s_ - began_s_ >= times_.session_s;
    if (!session_over_ && now_s_ - touched_s_ < times_.idle_s) {
      return false;
    }
    scene_ = ExhibitScene::attract;
  }
  began_s_ = now_s_;
  return true;
}

double Exhibit::welcome() const {
  if (scene_ != ExhibitScene::visitor) {
    return 0.0;
  }
  const double since_s = now_s_ - began_s_;
  return std::clamp(std::min(since_s, times_.welcome_s - since_s) / fade_s, 0.0, 1.0);
}

std::optional<double> Exhibit::ending_in_s() const {
  if (scene_ != ExhibitScene::visitor || times_.session_s <= 0.0) {
    return std::nullopt;
  }
  const double left_s = began_s_ + times_.session_s - now_s_;
  return left_s <= farewell_s ? std::optional(std::max(left_s, 0.0)) : std::nullopt;
}

bool HeldSwitch::advance(double now_s, bool held) {
  if (!held) {
    since_s_.reset();
    return false;
  }
  if (!since_s_) {
    since_s_ = now_s;
  }
  return now_s - *since_s_ >= hold_s_;
}

}  // namespace ergodome
