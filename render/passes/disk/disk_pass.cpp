#include "render/passes/disk/disk_pass.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "kernels/core/angles.h"
#include "kernels/disk/page_thorne.h"

namespace ergodome {

namespace {

//! Upper bound of the radius at which the Page-Thorne flux is largest, in units of the radius of
//! the innermost stable orbit.
constexpr double farthest_peak = 4.0;

//! Returns the largest flux of a disk around a hole of this spin, by golden-section search; the
//! flux has one peak.
double max_flux(Spacetime spacetime) {
  constexpr double golden = 0.61803398874989484820;
  double low = innermost_stable_radius(spacetime, 1.0);
  double high = farthest_peak * low;
  for (int round = 0; round < 80; ++round) {
    const double left = high - golden * (high - low);
    const double right = low + golden * (high - low);
    (page_thorne_flux(spacetime, left) < page_thorne_flux(spacetime, right) ? low : high) =
        page_thorne_flux(spacetime, left) < page_thorne_flux(spacetime, right) ? left : right;
  }
  return page_thorne_flux(spacetime, 0.5 * (low + high));
}

double temperature(const DiskSettings& disk, Spacetime spacetime, double r, double maximum) {
  if (disk.profile == DiskProfile::uniform) {
    return disk.temperature_k;
  }
  return disk.temperature_k * std::sqrt(std::sqrt(page_thorne_flux(spacetime, r) / maximum));
}

//! Lifetime of a cloud of the pattern, in periods of a circular orbit at twice the radius of the
//! disk's inner edge.
constexpr double life_in_turns = 2.0;

}  // namespace

double inner_edge(const DiskSettings& disk, Spacetime spacetime) {
  const double first = disk.plunging ? horizon_radius(spacetime) : innermost_stable_radius(spacetime, 1.0);
  return std::max(disk.inner.value_or(first), first);
}

double disk_temperature(const DiskSettings& disk, Spacetime spacetime, double r) {
  return temperature(disk, spacetime, r, max_flux(spacetime));
}

PatternTime pattern_time(const DiskSettings& disk, Spacetime spacetime, double hole_time) {
  const double r = 2.0 * inner_edge(disk, spacetime);
  const double period = life_in_turns * 2.0 * pi * (r * std::sqrt(r) + spacetime.spin);
  const double cycles = hole_time / period;
  const double whole = std::floor(cycles);
  // Number of whole periods modulo 2^32, because shows may run for years.
  const auto cycle = static_cast<std::uint32_t>(static_cast<std::int64_t>(std::fmod(whole, 4294967296.0)));
  return {static_cast<float>(period), static_cast<float>((cycles - whole) * period), cycle};
}

DiskPass::DiskPass(const Show& show, Backend backend)
    : colours_(backend), profile_(backend, profile_count, "disk profile") {
  set_numbers(show);
}

void DiskPass::set_numbers(const Show& show) {
  appearance_.shifted = show.effects.redshift;
  const Spacetime spacetime = spacetime_of(show);
  const std::shared_ptr<const FreeFall> orbit = show.disk->pattern == DiskPattern::none ? nullptr : show.camera.orbit;
  if (!disk_ || disk_->speed != show.disk->speed || spacetime_ != spacetime || orbit_ != orbit) {
    orbit_ = orbit;
    clock_ = HoleClock(spacetime, orbit, show.disk->speed);
  }
  if (disk_ == show.disk && spacetime_ == spacetime) {
    return;
  }
  disk_ = show.disk;
  spacetime_ = spacetime;
  appearance_.flow = converted_flow<float>(make_disk_flow(spacetime_));
  appearance_.inner_r = static_cast<float>(inner_edge(*disk_, spacetime_));
  appearance_.outer_r = static_cast<float>(disk_->outer);
  appearance_.colours = colours_.view();
  appearance_.log_unit = static_cast<float>(std::log(blackbody_tristimulus(disk_->temperature_k).y));
  appearance_.exposure = static_cast<float>(disk_->exposure);
  appearance_.opacity = static_cast<float>(disk_->opacity);
  appearance_.limb_darkened = disk_->limb_darkening;
  appearance_.contrast = disk_->pattern == DiskPattern::none ? 0.0F : static_cast<float>(disk_->contrast);
  make_profile();
}

void DiskPass::make_profile() {
  const double first_r = innermost_stable_radius(spacetime_, 1.0);
  const double last = std::sqrt(std::max(1.0 - first_r / disk_->outer, 1e-6));
  const double step = last / (profile_count - 1);
  const double maximum = max_flux(spacetime_);
  std::vector<float> entries(profile_count);
  for (int i = 0; i < profile_count; ++i) {
    const double way = step * i;
    entries[static_cast<std::size_t>(i)] =
        static_cast<float>(temperature(*disk_, spacetime_, first_r / (1.0 - way * way), maximum));
  }
  profile_.write(entries.data(), entries.size());
  appearance_.profile = {profile_.data(), profile_count, static_cast<float>(first_r), static_cast<float>(step)};
}

bool DiskPass::is_visible() const { return appearance_.outer_r > appearance_.inner_r && appearance_.opacity > 0.0F; }

DiskAppearance DiskPass::look_at(double time_s, double clock_lead) const {
  DiskAppearance look = appearance_;
  look.pattern = pattern_time(*disk_, spacetime_, clock_.time(time_s) + clock_lead);
  return look;
}

}  // namespace ergodome
