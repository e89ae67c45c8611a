#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <utility>

namespace ergodome {

//! A monotonic clock [s].
using SecondsSource = std::function<double()>;

//! Returns the time of the machine's steady clock [s].
double steady_seconds();

//! Kinds of work that are done, unit by unit, before a show starts.
enum class StartWork { reference, lens, small_picture, picture };

//! A time limit for work: no unit of work starts that may exceed it, judging by earlier units of
//! the same kind.
class Deadline {
 public:
  Deadline(SecondsSource now, double limit_s) : now_(std::move(now)), begin_s_(now_()), limit_s_(limit_s) {}

  //! Runs a unit of work if it is expected to end before `share` of the time limit has passed.
  //! Returns whether the unit ran. A unit is expected to take `growth` times the longest earlier
  //! unit of its kind; for the first one, `expected_s`, but at least a quarter of `share` of the
  //! time limit.
  bool run(StartWork kind, const std::function<void()>& work, double share = 1.0, double growth = 1.5,
           double expected_s = 0.0) {
    constexpr double unknown_share = 0.25;
    if (over_) {
      return false;
    }
    double& longest_s = longest_s_[static_cast<std::size_t>(kind)];
    const double begun_s = elapsed_s();
    const double needed_s =
        longest_s > 0.0 ? growth * longest_s : std::max(unknown_share * share * limit_s_, expected_s);
    if (begun_s + needed_s > share * limit_s_) {
      cut_short_ = true;
      over_ = begun_s >= limit_s_;
      return false;
    }
    work();
    longest_s = std::max(longest_s, elapsed_s() - begun_s);
    return true;
  }

  [[nodiscard]] double elapsed_s() const { return now_() - begin_s_; }
  //! Returns the longest time of a unit of this kind [s]; 0 if there was none.
  [[nodiscard]] double longest_s(StartWork kind) const { return longest_s_[static_cast<std::size_t>(kind)]; }
  //! Returns whether any work was skipped.
  [[nodiscard]] bool cut_short() const { return cut_short_; }

 private:
  SecondsSource now_;
  double begin_s_;
  double limit_s_;
  std::array<double, 4> longest_s_{};
  bool cut_short_ = false;
  bool over_ = false;  //!< the whole limit has passed, so run() need not read the clock
};

}  // namespace ergodome
