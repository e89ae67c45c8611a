#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/exhibit/black_view.h"
#include "app/exhibit/exhibit.h"
#include "app/exhibit/saved_settings.h"
#include "app/playback/transport.h"
#include "content/show/show.h"

namespace ergodome {

//! Options of an exhibit.
struct ExhibitOptions {
  ExhibitTimes times;
  //! The attract show; empty: usual_attract_show().
  std::string attract;
  std::filesystem::path state;  //!< folder of the saved settings; empty: settings are not saved
};

//! The visitors' show if the command line names none.
inline constexpr const char* usual_visitor_show = "exhibit";

//! Returns the name of the built-in attract show that suits a visitors' show: one for flat screens
//! if it is a pinhole view, otherwise one for domes.
std::string usual_attract_show(const Show& visitor);

//! Returns an error text if one of the shows is for flat screens (a pinhole view) and the other is
//! not; otherwise an empty text.
std::string attract_mismatch(const Show& visitor, const Show& attract);

//! The scenes of an exhibit with their captions (welcome, countdown), the operator's exit, and the
//! operator's saved settings.
class ExhibitScenes {
 public:
  //! Visitors fly through `visitor`; `attract` plays while there is no visitor.
  ExhibitScenes(ExhibitOptions options, Show visitor, Show attract);

  //! Advances by one frame, to a time of a monotonic clock. `touched`: there was input since the
  //! last frame; `chord_held`: the operator's exit keys are down. Returns whether the scene
  //! changed.
  bool advance(double now_s, bool touched, bool chord_held);

  [[nodiscard]] ExhibitScene scene() const { return exhibit_.scene(); }
  //! Returns the show of the current scene.
  [[nodiscard]] const Show& show() const { return scene() == ExhibitScene::visitor ? visitor_ : attract_; }
  //! Returns the visitors' show and the attract show.
  [[nodiscard]] std::vector<Show> shows() const { return {visitor_, attract_}; }
  //! In each scene whose show has the name and folder of `show`, replaces that show by `show`.
  void renew(const Show& show);
  //! Returns whether an operator has ever held the exit keys for three seconds.
  [[nodiscard]] bool left() const { return left_; }

  //! captions() returns the captions for visitors (the countdown, the hint about a black view, or
  //! the welcome), opacity() their common opacity. `pad` means that a controller is connected.
  [[nodiscard]] std::vector<Caption> captions(bool pad) const;
  [[nodiscard]] double opacity() const;
  //! Records the lit fraction of a visitor's view, 0 to 1. Does nothing during the attract show.
  void note_light(double lit_part);
  //! Returns true, once, if a visitor's view has been black for BlackView::return_after_s, so that
  //! the camera has to return to the start.
  [[nodiscard]] bool take_return();
  //! Returns whether the countdown to the end of the visit is shown.
  [[nodiscard]] bool is_ending() const { return exhibit_.ending_in_s().has_value(); }

  //! saved_commands() returns commands that apply the operator's settings (at the start: those
  //! saved by the last run). damage() returns why a settings file could not be read; empty if there
  //! was no such problem.
  [[nodiscard]] std::vector<TransportCommand> saved_commands() const;
  [[nodiscard]] const std::string& damage() const { return damage_; }
  //! Returns why the current settings cannot be saved, and the remedy; empty if they are saved or
  //! about to be.
  [[nodiscard]] const std::string& problem() const { return problem_; }

  //! Records an operator's commands for the next keep(), which saves the settings that they change.
  //! Changes by visitors' keys and controllers are not passed here and end with the visit.
  void note(const std::vector<TransportCommand>& commands);
  //! Returns the commands of a visitor's reset: the reset, then the operator's exposure and, if
  //! set, baseline.
  [[nodiscard]] std::vector<TransportCommand> reset_commands() const;
  //! Takes from `status` the settings that recorded commands have changed, and saves them: at once,
  //! but at most once a second. `baseline_set`: the baseline is not the show's. After a failure,
  //! problem() gives the reason, and the next attempt follows after ten seconds.
  void keep(const PlayerStatus& status, bool baseline_set);
  //! Writes settings that keep() has not written yet, at the end of the program.
  void keep_last();

  //! Returns the names of the visitors' show and the attract show.
  [[nodiscard]] std::string shows_text() const;

  //! Returns the state of the exhibit in one sentence for operators.
  [[nodiscard]] std::string state_text(const PlayerStatus& status) const;

 private:
  void write_settings();
  [[nodiscard]] std::vector<Caption> black_view_captions(double back_in_s, bool pad) const;

  ExhibitOptions options_;
  Show visitor_;
  Show attract_;
  Exhibit exhibit_;
  HeldSwitch chord_;
  BlackView black_view_;
  bool left_ = false;
  double now_s_ = 0.0;
  SavedSettings saved_;  //!< settings as stored in the file
  SavedSettings noted_;  //!< the operator's current settings
  std::vector<TransportCommand> asked_;
  double wrote_s_ = -1e300;
  double refused_s_ = -1e300;  //!< time of the last failed write
  std::string damage_;
  std::string problem_;
};

}  // namespace ergodome
