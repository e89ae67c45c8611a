#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <utility>

namespace ergodome {

//! Seconds of a clock that only goes forward.
using SecondsSource = std::function<double()>;

//! Seconds of the machine's steady clock.
double steady_seconds();

//! What is done before a show begins, a piece at a time.
enum class StartWork { reference, lens, small_picture, picture };

//! A time that work must not pass: no piece is begun that may not end in it, as far as pieces of its kind so far tell.
class Deadline {
 public:
  Deadline(SecondsSource now, double limit_s) : now_(std::move(now)), begin_s_(now_()), limit_s_(limit_s) {}

  //! Does a piece of work, if it will end within a share of the time; whether it did. `growth`: what it may take of the longest of its
  //! kind so far; where there was none, `expected_s`, and a quarter of the time at the least.
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
  //! What the longest piece of a kind took [s]; 0 where there was none.
  [[nodiscard]] double longest_s(StartWork kind) const { return longest_s_[static_cast<std::size_t>(kind)]; }
  //! Whether something was left out.
  [[nodiscard]] bool cut_short() const { return cut_short_; }

 private:
  SecondsSource now_;
  double begin_s_;
  double limit_s_;
  std::array<double, 4> longest_s_{};
  bool cut_short_ = false;
  bool over_ = false;  //!< no clock need be asked any more
};

}  // namespace ergodome
