#include <fmt/format.h>

#include "app/player/player.h"

// What a player does where its show's file, or one that this names, has been saved.
namespace ergodome {

void Player::reload(bool now) {
  const auto result = services_.reloaded(now);
  if (!result) {
    return;
  }
  if (result->show) {
    // What runs goes on until all of the new version is there.
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
