#include <fmt/format.h>

#include <utility>

#include "app/cli/interrupt.h"
#include "app/player/player.h"

// The parts of Player that only exhibits need.
namespace ergodome {

void Player::advance_exhibit(PlayerInput& input) {
  if (!exhibit_) {
    return;
  }
  const bool another = exhibit_->advance(session_->now_s(), inputs_.touched(), inputs_.chord_held());
  if (exhibit_->left()) {
    end("an operator ended it with keys or buttons");
  }
  if (exhibit_->scene() == ExhibitScene::attract) {
    input.actions.clear();  // visitors cannot control the attract show
    input.steering = {};
  }
  exhibit_->note(input.commands);
  operator_log_.note(input.commands, session_->now_s());
  services_.log_changes(operator_log_.take(session_->now_s()));
  if (exhibit_->take_return()) {
    input.actions.push_back(KeyAction::reset);
    services_.tell(spdlog::level::info, "the view was completely black; the camera was reset to the start");
  }
  if (std::erase(input.actions, KeyAction::reset) > 0) {
    const std::vector<TransportCommand> reset = exhibit_->reset_commands();
    input.commands.insert(input.commands.end(), reset.begin(), reset.end());
  }
  if (another) {
    change_scene();
  }
}

bool Player::add_light(PictureRequest& wish) {
  constexpr double between_measurements_s = 1.0;
  if (!exhibit_ || exhibit_->scene() != ExhibitScene::visitor) {
    return false;
  }
  const double now_s = session_->now_s();
  if (session_->changed()) {
    view_changed_s_ = now_s;
  }
  if (view_changed_s_ <= light_noted_s_ || now_s - light_noted_s_ < between_measurements_s) {
    return false;
  }
  wish.light_asked_s = now_s;
  return true;
}

void Player::note_light() {
  const std::optional<ViewLight>& light = pictures_.report().light;
  if (exhibit_ && light && light->asked_s > light_noted_s_) {
    light_noted_s_ = light->asked_s;
    // A measurement requested before the scene changed belongs to the other scene.
    if (light->asked_s >= scene_began_s_) {
      exhibit_->note_light(light->lit_part);
    }
  }
}

void Player::change_scene() {
  const bool visitor = exhibit_->scene() == ExhibitScene::visitor;
  keep_recording(RecordingMoment::end);
  if (renderers_.renews()) {
    // The version is read again when its scene returns.
    services_.forget_version();
  }
  renderers_.enter(exhibit_->scene(), exhibit_->show());
  begin(exhibit_->show(), visitor);
  scene_began_s_ = session_->now_s();
  services_.tell(spdlog::level::info, visitor ? "a visitor arrived: free flight starts" : "the attract show starts");
}

void Player::keep_settings(PlayerStatus& status) {
  const std::string before = exhibit_->problem();
  exhibit_->keep(status, session_->playback().baseline().has_value());
  const std::string& now = exhibit_->problem();
  if (now != before) {
    const bool kept = now.empty();
    services_.tell(kept ? spdlog::level::info : spdlog::level::err, kept ? "settings are saved again" : now);
  }
  if (status.problem.empty()) {
    status.problem = now;
  }
}

std::string Player::start_text() const {
  return fmt::format("exhibit started: ergodome {}, {}, {}, {}", ERGODOME_VERSION, exhibit_->shows_text(),
                     renderers_.backend(), services_.remote_text());
}

std::string Player::end_text() const {
  const std::string closed = why_ended_.empty() ? "the window was closed" : why_ended_;
  return "exhibit ended: " + (interrupted() ? "a signal was received" : closed);
}

}  // namespace ergodome
