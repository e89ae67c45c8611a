#include "app/player/session_pictures.h"

#include <utility>

namespace ergodome {

SessionPictures::SessionPictures(const RendererLoader::Make& make, Output& output, int size_px,
                                 const std::optional<PlayPlan>& plan)
    : renderers_(make), flow_([&output](PictureAnswer& answer) { output.take(answer); }, size_px) {
  if (plan) {
    budget_.emplace(*plan);
  }
}

PictureNews SessionPictures::advance(const PlayerSession& session, PictureRequest wish, bool changed) {
  constexpr int max_failures = 5;
  wish.renderer = renderers_.current();
  wish.disparity_asked = wish.disparity_asked || session.times_shown();
  add_budget(wish, session.now_s());
  const bool resized = std::exchange(window_, wish.output.window) != wish.output.window;
  const std::optional<PictureHead> head =
      wish.output.head ? std::optional(PictureHead(*wish.output.head)) : std::nullopt;
  const bool turned = std::exchange(head_, head) != head;
  changed = changed || resized || turned || !wish.output.eyes.empty() || session.changed();
  const PictureNews news = flow_.advance(wish, changed, session.moving());
  if (news == PictureNews::none) {
    return news;
  }
  failures_ = news == PictureNews::problem ? failures_ + 1 : 0;
  if (news == PictureNews::hang || failures_ >= max_failures) {
    failures_ = 0;
    renderers_.lose(session.show());
  }
  if (news == PictureNews::picture && budget_) {
    note_budget(session.now_s());
  }
  return news;
}

SceneRenderers::News SessionPictures::take_renderer(const Show& show) {
  SceneRenderers::News news = renderers_.advance(show);
  failures_ = news.another ? 0 : failures_;
  return news;
}

bool SessionPictures::shows_now(double now_s, double light) {
  constexpr double longest_s = 0.1;
  // Drawing a window takes time from the next picture if software draws it, as on most machines
  // whose CPU renders pictures, or if there is a frame rate to hold. Then the window is not drawn
  // again without a new picture, except after `longest_s`.
  const std::shared_ptr<ShowRenderer>& renderer = renderers_.current();
  const bool saves_time =
      (renderer && renderer->backend() == Backend::cpu) || (budget_ && budget_->plan().budget.frame_rate_hz);
  const bool dims = std::exchange(shown_light_, light) != light;
  if (saves_time && !dims && shown_pictures_ == report().pictures && now_s < shown_s_ + longest_s) {
    return false;
  }
  shown_pictures_ = report().pictures;
  shown_s_ = now_s;
  return true;
}

void SessionPictures::add_budget(PictureRequest& wish, double now_s) {
  if (!budget_) {
    return;
  }
  const PlayPlan& plan = budget_->plan();
  const Rung rung = budget_->rung();
  wish.quality = rung.quality;
  wish.whole_px = plan.whole_px;
  wish.patience_s = 1e-3 * plan.patience_ms;
  wish.errors_asked = budget_->wants_errors(now_s);
  wish.error_seed = static_cast<std::uint64_t>(report().pictures);
  if (plan.budget.frame_rate_hz) {
    flow_.hold({rung.size_px, 1e-3 * plan.budget.frame_ms()});
  }
}

void SessionPictures::note_budget(double now_s) {
  budget_->note_picture(report().frame_time_ms, report().interval_ms);
  if (report().errors_px) {
    budget_->note_errors(*report().errors_px);
    budget_->ask_errors(now_s);
  }
}

}  // namespace ergodome
