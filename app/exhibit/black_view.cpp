#include "app/exhibit/black_view.h"

#include <algorithm>

namespace ergodome {

void BlackView::note(double now_s, double lit_part) {
  if (!(lit_part < min_lit_part)) {
    since_s_.reset();
  } else if (!since_s_) {
    since_s_ = now_s;
  }
}

std::optional<double> BlackView::back_in_s(double now_s) const {
  if (!since_s_ || now_s - *since_s_ < hint_after_s) {
    return std::nullopt;
  }
  return std::max(*since_s_ + return_after_s - now_s, 0.0);
}

bool BlackView::take_return(double now_s) {
  if (!since_s_ || now_s - *since_s_ < return_after_s) {
    return false;
  }
  begin();
  return true;
}

}  // namespace ergodome
