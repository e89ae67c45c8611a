#include "app/budget/settings_ladder.h"

#include <algorithm>
#include <optional>

#include "app/budget/budget_choice.h"

namespace ergodome {

namespace {

//! Ratio of adjacent widths: a third fewer pixels.
constexpr double width_step = 0.82;
//! Without an error in the budget, lenses with a larger measured error than this come after smaller
//! pictures [px].
constexpr double unseen_px = 1.0;
//! A rung is only added if its predicted time is less than this times that of the one before.
constexpr double min_gain = 0.97;

class LadderMaker {
 public:
  LadderMaker(std::span<const MeasuredSetting> settings, const LadderLimits& limits)
      : settings_(settings), limits_(limits) {}

  void add(const MeasuredSetting& lens, int size_px, bool plain_filter) {
    Rung rung{lens.quality, size_px, lens.error_px, lens.moments, frame_ms(lens, size_px, plain_filter)};
    const MeasuredSetting* const direct = direct_twin(lens);
    if (direct != nullptr && lens.quality.lens == LensChoice::automatic) {
      // The renderer may select the grid or direct rays, so the larger error counts.
      rung.error_px = std::max(rung.error_px, direct->error_px);
    }
    if (plain_filter) {
      rung.quality.filter = SkyFilter::point;
    }
    const bool known = ladder_.empty() || !std::isnan(ladder_.front().frame_ms);
    if (ladder_.empty() || !known || rung.frame_ms < min_gain * ladder_.back().frame_ms) {
      ladder_.push_back(rung);
    }
  }

  [[nodiscard]] std::vector<Rung> take() { return std::move(ladder_); }

 private:
  //! Returns the setting with the same budget and filter, but direct rays; null if not measured.
  [[nodiscard]] const MeasuredSetting* direct_twin(const MeasuredSetting& lens) const {
    const auto found = std::ranges::find_if(settings_, [&](const MeasuredSetting& each) {
      return each.quality == FrameQuality{lens.quality.budget_px, LensChoice::direct, lens.quality.filter};
    });
    return found != settings_.end() ? &*found : nullptr;
  }

  //! Returns a measured setting of this kind of lens with the point filter. The budget of that
  //! setting does not matter, because the time that the point filter saves does not depend on the
  //! budget. Returns null if there is no such setting.
  [[nodiscard]] const MeasuredSetting* plain_twin(const MeasuredSetting& lens) const {
    const auto found = std::ranges::find_if(settings_, [&](const MeasuredSetting& each) {
      return each.quality.lens == lens.quality.lens && each.quality.filter == SkyFilter::point;
    });
    return found != settings_.end() ? &*found : nullptr;
  }

  [[nodiscard]] double frame_ms(const MeasuredSetting& lens, int size_px, bool plain_filter) const {
    const double width_share = static_cast<double>(size_px) / limits_.widest_px;
    const double pixel_share = width_share * width_share;
    const MeasuredSetting* const direct = direct_twin(lens);
    const bool by_rays = lens.quality.lens == LensChoice::automatic && direct != nullptr &&
                         !std::isnan(direct->picture_ms()) &&
                         limits_.height_to_width * size_px * size_px < limits_.grid_from_pixels;
    const double time_ms = by_rays ? direct->picture_ms(pixel_share)
                                   : std::min(lens.lens_ms, limits_.patience_ms) + lens.picture_ms(pixel_share);
    const MeasuredSetting* const plain = plain_filter ? plain_twin(lens) : nullptr;
    return plain == nullptr ? time_ms : time_ms + plain->picture_ms(pixel_share) - lens.picture_ms(pixel_share);
  }

  std::span<const MeasuredSetting> settings_;
  LadderLimits limits_;
  std::vector<Rung> ladder_;
};

//! Returns the settings with the first one's kind of lens and filter, those with the finest budget
//! first.
std::vector<MeasuredSetting> ladder_lenses(std::span<const MeasuredSetting> settings) {
  std::vector<MeasuredSetting> lenses;
  const FrameQuality first = settings.front().quality;
  std::ranges::copy_if(settings, std::back_inserter(lenses), [&](const MeasuredSetting& each) {
    return each.quality.lens == first.lens && each.quality.filter == first.filter;
  });
  std::ranges::stable_sort(lenses, {}, [](const MeasuredSetting& each) { return each.quality.budget_px; });
  return lenses;
}

std::vector<int> ladder_widths(const LadderLimits& limits) {
  std::vector<int> widths;
  for (double width = limits.widest_px; width > limits.narrowest_px; width *= width_step) {
    widths.push_back(static_cast<int>(std::lround(width)));
  }
  widths.push_back(std::min(limits.narrowest_px, limits.widest_px));
  return widths;
}

//! Returns the lenses that come before smaller pictures; the last of them is used at all sizes.
//! With an error in the budget: one, choose_setting() for that error. Without: all before the first
//! whose error exceeds `unseen_px`, at least one. `lenses` starts with the finest budget.
std::span<const MeasuredSetting> fine_lenses(std::span<const MeasuredSetting> lenses, const Budget& budget) {
  if (budget.error_px) {
    const BudgetChoice choice = choose_setting(lenses, {budget.error_px, std::nullopt}, BudgetFirst::error);
    return lenses.subspan(choice.setting, 1);
  }
  const auto coarse =
      std::ranges::find_if(lenses, [](const MeasuredSetting& each) { return each.error_px > unseen_px; });
  return lenses.first(static_cast<std::size_t>(std::max<std::ptrdiff_t>(coarse - lenses.begin(), 1)));
}

}  // namespace

std::vector<Rung> settings_ladder(std::span<const MeasuredSetting> settings, const Budget& budget,
                                  const LadderLimits& limits) {
  const std::vector<MeasuredSetting> lenses = ladder_lenses(settings);
  const std::vector<int> widths = ladder_widths(limits);
  const std::span<const MeasuredSetting> fine = fine_lenses(lenses, budget);
  LadderMaker maker(settings, limits);
  for (const MeasuredSetting& lens : fine) {
    maker.add(lens, widths.front(), false);
  }
  for (const int width : widths) {
    maker.add(fine.back(), width, false);
  }
  const bool may_filter_plainly = fine.back().quality.filter == SkyFilter::ewa;
  maker.add(fine.back(), widths.back(), may_filter_plainly);
  for (const MeasuredSetting& lens : lenses) {
    if (lens.quality.budget_px > fine.back().quality.budget_px) {
      maker.add(lens, widths.back(), may_filter_plainly);
    }
  }
  return maker.take();
}

std::size_t first_rung(std::span<const Rung> ladder, double frame_ms) {
  const auto found =
      std::ranges::find_if(ladder, [&](const Rung& rung) { return rung.frame_ms <= foretold_share * frame_ms; });
  const auto smallest = std::ranges::min_element(ladder, {}, &Rung::size_px);
  return static_cast<std::size_t>((found != ladder.end() ? found : smallest) - ladder.begin());
}

}  // namespace ergodome
