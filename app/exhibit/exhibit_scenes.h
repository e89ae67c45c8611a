#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/exhibit/black_view.h"
#include "app/exhibit/exhibit.h"
#include "app/exhibit/kept_settings.h"
#include "app/playback/transport.h"
#include "content/show/show.h"

namespace ergodome {

struct ExhibitOptions {
  ExhibitTimes times;
  std::string attract;          //!< the show that runs by itself; empty: the one that fits the visitors' show
  std::filesystem::path state;  //!< folder of the settings that are kept; empty: none are
};

//! The show that visitors fly through where the command line names none.
inline constexpr const char* usual_visitor_show = "exhibit";

//! Returns the built-in attract show for displays of a visitors' show: a flat one for flat screens, or one for domes.
std::string usual_attract_show(const Show& visitor);

//! Returns why an attract show does not fit the display that visitors' pictures are made for, and what to do; empty where it does.
std::string attract_mismatch(const Show& visitor, const Show& attract);

//! What an exhibit does beside showing scenes: it welcomes, counts down, lets an operator out, and keeps what one has set.
class ExhibitScenes {
 public:
  //! `visitor`: the show that people fly through; `attract`: the one that runs by itself.
  ExhibitScenes(ExhibitOptions options, Show visitor, Show attract);

  //! Once a frame, by a clock that never goes back. Returns whether the scene became another one.
  bool advance(double now_s, bool touched, bool chord_held);

  [[nodiscard]] ExhibitScene scene() const { return exhibit_.scene(); }
  //! The scene's show.
  [[nodiscard]] const Show& show() const { return scene() == ExhibitScene::visitor ? visitor_ : attract_; }
  //! Another version of a scene's show, or of both scenes' where they have one, for now and whenever the scene comes again.
  void renew(const Show& show);
  //! Whether an operator has held the chord long enough.
  [[nodiscard]] bool left() const { return left_; }

  //! What is to be read by visitors now, and how much of it is to be seen. `pad`: one is there to fly with.
  [[nodiscard]] std::vector<Caption> captions(bool pad) const;
  [[nodiscard]] double opacity() const;
  //! Takes the lit part of a visitor's view, 0 to 1.
  void note_light(double lit_part);
  //! Returns true once, when nothing but black was in view for a while: the camera is to go back to the start.
  [[nodiscard]] bool take_return();
  //! Whether the visitor is being told that the next one is about to fly.
  [[nodiscard]] bool is_ending() const { return exhibit_.ending_in_s().has_value(); }

  //! What was set before the last end of the program, as commands; and why there may be none.
  [[nodiscard]] std::vector<TransportCommand> kept_commands() const;
  [[nodiscard]] const std::string& damage() const { return damage_; }
  //! Why what is set now would be lost with the program, and what to do; empty where it is kept, or about to be.
  [[nodiscard]] const std::string& problem() const { return problem_; }

  //! Notes what an operator asks for in this frame: what that sets is kept, while what visitors change by their keys and pads ends with their visit.
  void note(const std::vector<TransportCommand>& commands);
  //! What a visitor's reset is for the player: an operator's settings are none of it.
  [[nodiscard]] std::vector<TransportCommand> reset_commands() const;
  //! Takes what was noted since the last call from what is set now, and writes it at once; what changes all the time is written once a second. A
  //! disk that refuses is told in problem(), and asked again every ten seconds.
  void keep(const PlayerStatus& status, bool baseline_set);
  //! Writes what keep() has not written yet: the program ends.
  void keep_last();

  //! What visitors fly through, and what runs by itself, by the names of the shows.
  [[nodiscard]] std::string shows_text() const;

  //! What the exhibit does, in a sentence for whoever looks after the machine.
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
  KeptSettings kept_;   //!< in the file
  KeptSettings noted_;  //!< now
  std::vector<TransportCommand> asked_;
  double wrote_s_ = -1e300;
  double refused_s_ = -1e300;  //!< by the disk
  std::string damage_;
  std::string problem_;
};

}  // namespace ergodome
