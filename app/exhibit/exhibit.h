#pragma once

#include <optional>

namespace ergodome {

//! How long an exhibit waits.
struct ExhibitTimes {
  double idle_s = 60.0;      //!< without a touch, after which the attract show comes back
  double session_s = 180.0;  //!< that one visitor may fly; 0: as long as they touch it
  double welcome_s = 8.0;    //!< that the welcome is to be read
  double rest_s = 3.0;       //!< after a session, in which touches are not taken for a new visitor's
};

//! What an exhibit shows: a show that runs for itself, or the flight of a visitor.
enum class ExhibitScene { attract, visitor };

//! Decides what an exhibit shows, by who touches it when.
class Exhibit {
 public:
  explicit Exhibit(const ExhibitTimes& times) : times_(times) {}

  //! Goes on to a time of a clock that never goes back. `touched`: somebody did something since the last call. Returns whether the scene
  //! became another one.
  bool advance(double now_s, bool touched);

  [[nodiscard]] ExhibitScene scene() const { return scene_; }

  //! How much of the welcome is to be seen, 0 to 1: it comes with the visitor and fades.
  [[nodiscard]] double welcome() const;

  //! Time that is left of a session, where it is limited and about to end.
  [[nodiscard]] std::optional<double> ending_in_s() const;

 private:
  ExhibitTimes times_;
  ExhibitScene scene_ = ExhibitScene::attract;
  double now_s_ = 0.0;
  double began_s_ = 0.0;    //!< the scene
  double touched_s_ = 0.0;  //!< last
  bool session_over_ = false;
};

//! A switch that must be held: an operator's way out of a locked exhibit.
class HeldSwitch {
 public:
  explicit HeldSwitch(double hold_s) : hold_s_(hold_s) {}

  //! Whether it has been held long enough, by a clock that never goes back.
  bool advance(double now_s, bool held);

 private:
  double hold_s_;
  std::optional<double> since_s_;
};

}  // namespace ergodome
