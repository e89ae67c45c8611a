#pragma once

#include <optional>

namespace ergodome {

//! Time constants of an exhibit.
struct ExhibitTimes {
  double idle_s = 60.0;      //!< time without input after which the attract show returns
  double session_s = 180.0;  //!< maximum duration of a visitor's flight; 0: no limit
  double welcome_s = 8.0;    //!< duration of the welcome text
  //! Time after a session that reached session_s, during which input does not start another.
  double rest_s = 3.0;
};

//! Scene of an exhibit: the attract show or a visitor's flight.
enum class ExhibitScene { attract, visitor };

//! Selects the scene of an exhibit from the times of visitors' input.
class Exhibit {
 public:
  explicit Exhibit(const ExhibitTimes& times) : times_(times) {}

  //! Advances to a time of a monotonic clock. `touched` means that there was input since the last
  //! call. Returns whether the scene changed.
  bool advance(double now_s, bool touched);

  [[nodiscard]] ExhibitScene scene() const { return scene_; }

  //! Returns the opacity of the welcome text, 0 to 1: it fades in when a visitor starts, and out
  //! before welcome_s have passed.
  [[nodiscard]] double welcome() const;

  //! Returns the remaining time of a visitor's session [s] in its last 20 s. Returns nothing before
  //! them, without a limit, and during the attract show.
  [[nodiscard]] std::optional<double> ending_in_s() const;

 private:
  ExhibitTimes times_;
  ExhibitScene scene_ = ExhibitScene::attract;
  double now_s_ = 0.0;
  double began_s_ = 0.0;    //!< time of the scene's start
  double touched_s_ = 0.0;  //!< time of the last input
  //! Whether the last visitor's session ended because it reached its limit.
  bool session_over_ = false;
};

//! A switch that must be held down, which lets an operator leave a locked exhibit.
class HeldSwitch {
 public:
  explicit HeldSwitch(double hold_s) : hold_s_(hold_s) {}

  //! Advances to a time of a monotonic clock. Returns whether the switch has been held without a
  //! break for the time given to the constructor.
  bool advance(double now_s, bool held);

 private:
  double hold_s_;
  std::optional<double> since_s_;
};

}  // namespace ergodome
