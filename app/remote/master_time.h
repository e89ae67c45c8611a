#pragma once

#include <chrono>

namespace ergodome {

//! What a master clock outside said: the show stood at `show_time_s` at the instant `at`, and ran at `speed`.
struct MasterTime {
  double show_time_s = 0.0;
  double speed = 1.0;  //!< show seconds a second; 0 where the master stands still
  std::chrono::steady_clock::time_point at;
};

}  // namespace ergodome
