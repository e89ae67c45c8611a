#include <fmt/format.h>

#include <utility>

#include "app/cli/lens_options.h"
#include "app/exhibit/supervisor.h"
#include "app/player/player.h"
#include "app/player/player_texts.h"
#include "content/files/console.h"
#include "content/files/counted.h"
#include "render/passes/overlay/camera_readout.h"

// Texts of the player: on the screen, in its status, and on the terminal when it ends.
namespace ergodome {

bool Player::add_words(PictureRequest& wish) {
  if (!exhibit_) {
    return false;
  }
  if (options_.setup && session_->help_shown()) {
    wish.captions = {help_caption(help_text(HelpForm::words))};
    wish.captions_opacity = 1.0;
    wish.frame.captions = false;
  } else if (!session_->help_shown() || exhibit_->is_ending()) {
    // Help over the window would cover the welcome caption, and contains more.
    wish.captions = exhibit_->captions(!pad_snapshot_.pads.empty());
    wish.captions_opacity = exhibit_->opacity();
  }
  std::vector<LocalText> words;
  words.reserve(wish.captions.size());
  for (const Caption& caption : wish.captions) {
    words.push_back(caption.text);
  }
  const bool faded = std::exchange(words_opacity_, wish.captions_opacity) != wish.captions_opacity;
  return std::exchange(words_, words) != words || faded;
}

std::string Player::help_text(HelpForm form) const {
  HelpChoice choice;
  choice.pads = !pad_snapshot_.pads.empty();
  choice.reader = exhibit_ ? ActionUser::visitor : ActionUser::presenter;
  choice.language = session_->playback().language();
  choice.form = form;
  return inputs_.controls().help_text(choice);
}

void Player::update_texts() {
  if (session_->playback().dark()) {
    // A blackout hides all text.
    for (const PanelPlace place : {PanelPlace::top_left, PanelPlace::bottom_middle, PanelPlace::middle}) {
      screen_.set_text(place, "");
    }
    return;
  }
  std::string times;
  if (session_->times_shown()) {
    times =
        times_text(pictures_.report(), session_->frame().stereo, renderers_.backend(), session_->playback().language());
    const CameraPose& pose = session_->frame().pose;
    times += '\n';
    times += text_in(readout_text(session_->spin(), pose.r, pose.theta), session_->playback().language());
    times += budget_ ? fmt::format("\n{}", budget_->display_text()) : "";
  }
  screen_.set_text(PanelPlace::top_left, times);
  // Captions for visitors use the same location and have priority. Nothing is shown in the attract
  // show, nor before the first picture of a flight, while the attract show's last picture remains.
  const bool quiet = options_.quiet || !words_.empty() ||
                     (exhibit_ && (exhibit_->scene() == ExhibitScene::attract || !renderers_.current()));
  screen_.set_text(PanelPlace::bottom_middle, quiet ? "" : session_->caption());
  screen_.set_text(PanelPlace::middle, session_->help_shown() ? help_text(HelpForm::cells) : "");
}

void Player::post_status() {
  PlayerStatus status;
  session_->fill(status);
  const PictureReport& report = pictures_.report();
  status.lens = report.lens;
  status.backend = renderers_.backend();
  status.frame_ms = report.frame_time_ms;
  status.frames = report.pictures;
  status.problem = report.problem;
  frame_times_.note(session_->now_s(), report.frame_time_ms);
  status.baseline_used = report.narrowed ? report.narrowed->baseline : status.baseline;
  status.worst_frame_ms = frame_times_.worst_ms();
  for (const PadView& pad : pad_snapshot_.pads) {
    status.pads.push_back(
        {pad.identity->name, pad.identity->connection, pad_snapshot_.time_s - pad.last_input_s < 1.0});
  }
  if (status.problem.empty()) {
    status.problem = recording_problem_;
  }
  services_.fill(status);
  if (exhibit_) {
    keep_settings(status);
    tell_supervisor(exhibit_->state_text(status));
  }
  services_.post(std::move(status));
}

void Player::print_statistics() const {
  if (pictures_.report().pictures > 0) {
    print_out("{} in {:.1f} s, not counting the first\n", counted(pictures_.report().pictures - 1, "frame"),
              std::chrono::duration<double>(Clock::now() - *first_answer_).count());
    if (budget_) {
      print_out("{}\n", budget_->summary_text());
    }
  }
  if (const auto streamed = renderers_.current() ? renderers_.current()->stream_statistics() : std::nullopt) {
    ergodome::print_statistics(*streamed);
  }
}

}  // namespace ergodome
