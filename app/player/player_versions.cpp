#include <fmt/format.h>

#include "app/player/player.h"

// Handling of saved changes to the show's file, or to files that it names.
namespace ergodome {

void Player::reload(bool now) {
  const auto result = services_.reloaded(now);
  if (!result) {
    return;
  }
  if (result->show) {
    // The current version runs until the new one is loaded completely.
    renderers_.renew(*result->show);
  } else {
    services_.tell(spdlog::level::err, result->problem);
    refuse_version(result->problem);
  }
}

void Player::take_version(const Show& show) {
  session_->set_show(show);
  services_.take_version(show);
  if (exhibit_) {
    exhibit_->renew(show);
  }
  services_.tell(spdlog::level::info, fmt::format("{} was reloaded", show.name));
}

void Player::refuse_version(const std::string& problem) {
  services_.refuse_version(problem);
  if (!exhibit_) {
    session_->say(problem);
  }
}

void Player::take_renderer() {
  const SceneRenderers::News news = renderers_.advance(session_->show());
  services_.tell(spdlog::level::err, news.problem);
  if (news.another) {
    failures_ = 0;
    if (news.version) {
      take_version(*news.version);
    }
    session_->show_again();
  } else if (news.version) {
    refuse_version(news.problem);
  }
}

}  // namespace ergodome
