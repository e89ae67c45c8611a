#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/playback/clock/show_clock.h"
#include "app/playback/external_clock.h"
#include "app/playback/sound/audio_mixer.h"
#include "app/playback/sound/fader.h"
#include "app/playback/transport.h"
#include "content/show/show.h"

namespace ergodome {

//! Settings of the playback of a show.
struct PlaybackSettings {
  //! The operator's choice; empty: English if available, otherwise the first.
  std::string language;
  std::chrono::nanoseconds blackout_fade = std::chrono::seconds(1);
  TimeSource source = steady_time;
};

//! Result of a command.
enum class CommandOutcome {
  done,
  //! To be done by other parts of the player: free flight, return to the path, reload; `reset` is
  //! done as far as it concerns playback.
  elsewhere,
  refused  //!< not possible; Playback::refusal gives the reason
};

//! Returns a note if a show has captions or sound, but neither in the chosen language nor in a
//! wider one ("de" for "de-AT"); otherwise, and if `language` is empty, "".
std::string language_note(const std::string& show, const Timeline& heard, const std::string& language);

//! A show's transport: its clock and the operator's settings, controlled by commands. Uses no
//! window and no threads.
class Playback {
 public:
  explicit Playback(const Show& show, PlaybackSettings settings = {});

  //! Replaces the show by another version. Keeps time, speed and settings, but changes a language
  //! that the new version lacks.
  void set_show(const Show& show);
  //! Makes the show follow an external clock; nullptr: its own clock, at normal speed.
  void follow(std::shared_ptr<ExternalClock> clock);

  CommandOutcome apply(const TransportCommand& command);
  [[nodiscard]] const std::string& refusal() const { return refusal_; }

  //! Sets instant() to the clock's current time, after following an external clock. Call it at the
  //! start of a frame and after its commands, so that all parts of a frame use the same instant.
  const ShowInstant& advance();
  [[nodiscard]] const ShowInstant& instant() const { return instant_; }
  //! Records that the picture of the latest or an earlier instant was shown. Frames skipped since
  //! the last one count as dropped.
  void note_shown(const ShowInstant& instant) { clock_.note_shown(instant); }

  //! Blacks out at once, for a show that follows a blacked-out one.
  void darken();
  //! Returns whether the show is blacked out or fading to black.
  [[nodiscard]] bool dark() const { return fader_.target() < 0.5; }

  //! Returns the factor on the display's light for a blackout, 0 to 1.
  [[nodiscard]] double light() const { return light_; }
  //! Returns the index of the current chapter; -1 before the first.
  [[nodiscard]] int chapter() const;
  [[nodiscard]] double exposure_stops() const { return exposure_stops_; }
  //! Returns the baseline that replaces the show's [M], if any.
  [[nodiscard]] std::optional<double> baseline() const { return baseline_; }
  //! Restores the show's baseline.
  void forget_baseline() { baseline_.reset(); }
  [[nodiscard]] const std::string& language() const { return language_; }
  [[nodiscard]] bool captions() const { return captions_; }
  [[nodiscard]] AudioCue audio_cue() const { return {instant_, volume_, language_}; }
  [[nodiscard]] ChaseState chase_state() const { return chase_state_; }

  //! Fills in the fields that playback determines; leaves the others unchanged.
  void fill(PlayerStatus& status) const;

 private:
  CommandOutcome move(const TransportCommand& command);
  CommandOutcome go_to_chapter(int index);
  CommandOutcome go_to_next_chapter();
  CommandOutcome go_to_previous_chapter();
  CommandOutcome choose_language(const std::string& tag);
  void choose_next_language();
  bool adjust(const TransportCommand& command);
  CommandOutcome refuse(std::string english, std::string german);
  //! Refuses a chapter with this reason, or because there are no chapters.
  CommandOutcome refuse_chapter(std::string english, std::string german);
  [[nodiscard]] std::string clock_text() const;
  void fill_clock(PlayerStatus& status) const;

  TimeSource source_;
  LocalText title_;
  double show_baseline_ = 0.0;
  bool stereo_ = false;
  std::vector<Chapter> chapters_;
  std::vector<std::string> languages_;

  ShowClock clock_;
  std::shared_ptr<ExternalClock> external_;
  ClockChaser chaser_;
  ChaseState chase_state_ = ChaseState::waiting;
  ShowInstant instant_;

  Fader fader_;
  double light_ = 1.0;
  double exposure_stops_ = 0.0;
  std::optional<double> baseline_;
  std::string language_;
  bool captions_ = true;
  double volume_ = 1.0;
  std::string refusal_;
};

//! Returns the input of the mixer for a show.
Soundtrack soundtrack_of(const Show& show);

}  // namespace ergodome
