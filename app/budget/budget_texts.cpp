#include "app/budget/budget_texts.h"

#include <fmt/format.h>

#include "content/files/printable.h"

namespace ergodome {

namespace {

//! Formats a time with about three digits.
std::string milliseconds(double time_ms) {
  return time_ms < 10.0 ? fmt::format("{:.2f} ms", time_ms)
                        : fmt::format("{:.{}f} ms", time_ms, time_ms < 100.0 ? 1 : 0);
}

std::string moments_text(int moments, int all) {
  if (all < 2) {
    return "at one moment";
  }
  return moments < all ? fmt::format("at the worst of {} measured moments, out of {}", moments, all)
                       : fmt::format("at the worst of {} moments", all);
}

std::string error_text(double error_px, int moments, std::size_t all) {
  if (std::isnan(error_px)) {
    return "error not measured (not enough time)";
  }
  return fmt::format("measured error {:.3g} px (99 % of the pixels, {})", error_px,
                     moments_text(moments, static_cast<int>(all)));
}

//! Describes what is known about the time of frames that were not timed.
std::string untimed_text(const SettingsMeasurement& measured) {
  if (!std::isnan(measured.quickest_ms)) {
    return fmt::format("more than {} per frame (measured with a picture {} px wide; there was no time for {})",
                       milliseconds(measured.quickest_ms), measured.quickest_px,
                       measured.quickest_px < measured.width_px ? "a larger one" : "another");
  }
  return measured.untimed == UntimedFrames::polygons
             ? "frame time not measured, because polygons take seconds to start without a GPU"
             : "frame time not measured (not enough time)";
}

std::string time_text(double frame_ms, const SettingsMeasurement& measured) {
  if (std::isnan(frame_ms)) {
    return untimed_text(measured);
  }
  const bool extrapolated = measured.drawn_px.size() > 1;
  return fmt::format("{} per frame{}", milliseconds(frame_ms),
                     extrapolated ? fmt::format(" (estimated from pictures {} and {} px wide)", measured.drawn_px[0],
                                                measured.drawn_px[1])
                                  : "");
}

std::string took_text(const SettingsMeasurement& measured) {
  return fmt::format("measuring took {:.1f} s{}", measured.took_s,
                     measured.cut_short ? ", not enough for all settings" : "");
}

//! Describes how an error, with the reserve of kept_share, and a frame time exceed the budget, or
//! that the frame rate is unknown; each part starts with a semicolon. Empty if the budget is met.
std::string missed_text(const Budget& budget, const SettingsMeasurement& measured, bool holds_error, double error_px,
                        bool holds_rate, double frame_ms) {
  std::string text;
  if (!holds_error && !std::isnan(error_px)) {
    const double over_px = error_px - *budget.error_px;
    text += over_px > 0.0 ? fmt::format("; this exceeds the error budget by {:.3g} px", over_px)
                          : "; this is more than half of the error budget, so other moments may exceed it";
  }
  if (!holds_rate && !std::isnan(frame_ms)) {
    text += fmt::format("; the frame rate is missed: a frame takes {} more than {}",
                        milliseconds(frame_ms - budget.frame_ms()), milliseconds(budget.frame_ms()));
  }
  if (budget.frame_rate_hz && std::isnan(frame_ms)) {
    text += measured.quickest_ms > budget.frame_ms()
                ? fmt::format("; the frame rate is missed: it allows {} per frame", milliseconds(budget.frame_ms()))
                : "; the frame rate is unknown";
    text += budget.error_px ? "" : ", so the fastest lens is used";
  }
  return text;
}

}  // namespace

std::string text_of(const FrameQuality& quality) {
  const char* lens = quality.lens == LensChoice::direct     ? "direct rays"
                     : quality.lens == LensChoice::live     ? "live lens"
                     : quality.lens == LensChoice::streamed ? "streamed lens"
                                                            : "lens";
  return fmt::format("{} at {:.3g} px{}", lens, quality.budget_px,
                     quality.filter == SkyFilter::point ? ", point sampling of the sky map" : "");
}

std::string choice_text(const Budget& budget, const SettingsMeasurement& measured, const BudgetChoice& choice) {
  const MeasuredSetting& setting = measured.settings[choice.setting];
  return fmt::format(
      "budget {}: {}; {}, {}{}; {}", text_of(budget), text_of(setting.quality),
      error_text(setting.error_px, setting.moments, measured.times_s.size()), time_text(setting.frame_ms(), measured),
      missed_text(budget, measured, choice.holds_error, setting.error_px, choice.holds_rate, setting.frame_ms()),
      took_text(measured));
}

std::string ladder_text(const Budget& budget, const SettingsMeasurement& measured, const std::vector<Rung>& ladder,
                        std::size_t first) {
  const Rung& rung = ladder[first];
  const bool holds_error = !budget.error_px || is_within(rung.error_px, *budget.error_px);
  const bool holds_rate = !budget.frame_rate_hz || rung.frame_ms <= budget.frame_ms();
  const std::string step = budget.frame_rate_hz ? fmt::format(", pictures {} px wide (of {}), step {} of {}",
                                                              rung.size_px, measured.width_px, first + 1, ladder.size())
                                                : "";
  return fmt::format(
      "budget {}: {}{}; {}, {}{}; {}", text_of(budget), text_of(rung.quality), step,
      error_text(rung.error_px, rung.moments, measured.times_s.size()), time_text(rung.frame_ms, measured),
      missed_text(budget, measured, holds_error, rung.error_px, holds_rate, rung.frame_ms), took_text(measured));
}

std::string record_text(const Budget& budget, const RateRecord& record, long changes, std::size_t rung,
                        std::size_t rungs) {
  if (record.frames() == 0) {
    return fmt::format("budget {}: nothing moved, so there was no frame rate to keep", text_of(budget));
  }
  const double rate_hz = record.rate_hz();
  const double off = rate_hz / *budget.frame_rate_hz - 1.0;
  return fmt::format(
      "budget {}: {:.2f} fps over {} ({:+.1f} % from the target), {:.1f} % of them late, the longest {:.0f} ms; "
      "settings changed {}, ending at step {} of {} (1: most accurate)",
      text_of(budget), rate_hz, counted(record.frames(), "frame"), 100.0 * off, 100.0 * record.late(),
      record.longest_ms(), counted(changes, "time"), rung + 1, rungs);
}

std::string check_text(const Budget& budget, const BudgetCheck& check) {
  const bool within = check.worst_px <= *budget.error_px;
  return fmt::format(
      "error at {} random moments: median {:.3g} px, worst {:.3g} px at {:.2f} s; {} the budget of {:g} px",
      check.moments, check.median_px, check.worst_px, check.worst_time_s, within ? "within" : "over", *budget.error_px);
}

}  // namespace ergodome
