#include "app/player/outputs/disparity_limit.h"

#include <algorithm>
#include <utility>

namespace ergodome {

bool DisparityLimit::is_due(double now_s) const {
  constexpr double interval_s = 1.0;
  return now_s - noted_s_ >= interval_s;
}

void DisparityLimit::note(double now_s, double range_deg, double comfort_deg) {
  if (!is_due(now_s)) {
    return;
  }
  noted_s_ = now_s;
  // The distance grows again only when there is some room, and slowly, so that it does not follow
  // every motion.
  constexpr double room = 0.8;
  constexpr double growth = 1.2;
  if (range_deg > comfort_deg) {
    news_ = news_ || factor_ == 1.0;
    factor_ *= comfort_deg / range_deg;
  } else if (range_deg < room * comfort_deg) {
    factor_ = std::min(1.0, growth * factor_);
  }
}

bool DisparityLimit::take_news() { return std::exchange(news_, false); }

}  // namespace ergodome
