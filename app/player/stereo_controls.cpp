#include "app/player/stereo_controls.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "content/show/stereo_eyes.h"

namespace ergodome {

namespace {

constexpr double step = 1.25;
constexpr double min_baseline = 1e-4;
constexpr double max_baseline = 100.0;
//! Values of the first step from baseline 0 and from convergence at infinity, in units of the
//! camera's radius; large enough to be seen. The limits here have the same unit.
constexpr double first_baseline = 0.01;
constexpr double first_convergence = 3.0;
constexpr double nearest_convergence = 0.01;
constexpr double farthest_convergence = 1000.0;

constexpr std::array window_layouts = {StereoLayout::mono,
                                       StereoLayout::side_by_side,
                                       StereoLayout::half_side_by_side,
                                       StereoLayout::top_bottom,
                                       StereoLayout::half_top_bottom,
                                       StereoLayout::anaglyph,
                                       StereoLayout::dubois,
                                       StereoLayout::rows};

StereoLayout after(StereoLayout layout) {
  const auto here = std::ranges::find(window_layouts, layout);
  const bool last = here == window_layouts.end() || here + 1 == window_layouts.end();
  return last ? window_layouts.front() : *(here + 1);
}

//! Rounds to tenths; never returns -0.0.
double tenths(double value) { return 0.1 * std::round(10.0 * value) + 0.0; }

}  // namespace

StereoSettings adjusted(const StereoSettings& stereo, KeyAction action, const StereoSettings& shown, double r) {
  StereoSettings made = stereo;
  switch (action) {
    case KeyAction::baseline_larger:
      made.baseline = stereo.baseline > 0.0 ? std::clamp(step * stereo.baseline, min_baseline * r, max_baseline * r)
                                            : first_baseline * r;
      break;
    case KeyAction::baseline_smaller:
      made.baseline = stereo.baseline / step < min_baseline * r ? 0.0 : stereo.baseline / step;
      break;
    case KeyAction::baseline_reset:
      made = shown;
      break;
    case KeyAction::convergence_nearer:
      made.convergence = stereo.convergence > 0.0 ? std::max(stereo.convergence / step, nearest_convergence * r)
                                                  : first_convergence * r;
      break;
    case KeyAction::convergence_farther:
      made.convergence = step * stereo.convergence > farthest_convergence * r ? 0.0 : step * stereo.convergence;
      break;
    case KeyAction::swap_eyes:
      made.swap_eyes = !stereo.swap_eyes;
      break;
    case KeyAction::tint_eyes:
      made.tint_eyes = !stereo.tint_eyes;
      break;
    case KeyAction::next_layout:
      made.layout = after(stereo.layout);
      break;
    case KeyAction::next_model:
      made.model = next_model(stereo.model);
      break;
    default:
      break;
  }
  return made;
}

std::string describe(const StereoSettings& stereo, std::string_view language) {
  if (eye_count(stereo) < 2) {
    return "mono";
  }
  const bool german = language == "de";
  const std::string convergence = stereo.convergence > 0.0 ? fmt::format("{:.4g} M", stereo.convergence)
                                  : german                 ? "unendlich"
                                                           : "infinity";
  return fmt::format("{}, {}, {} {:.4g} M, {} {}{}", stereo_layout_names[static_cast<std::size_t>(stereo.layout)],
                     stereo_model_names[static_cast<std::size_t>(stereo.model)], german ? "Basis" : "baseline",
                     stereo.baseline, german ? "Konvergenz" : "convergence", convergence,
                     !stereo.swap_eyes ? ""
                     : german          ? ", vertauscht"
                                       : ", swapped");
}

std::string disparity_caption(const StereoSettings& stereo, const std::optional<Disparity>& disparity,
                              std::string_view language) {
  std::string caption = describe(stereo, language);
  if (!disparity) {
    return caption;
  }
  const bool german = language == "de";
  const char* const to = german ? "bis" : "to";
  caption += fmt::format("\n{} {:+.1f} {} {:+.1f} px, {:+.1f} {} {:+.1f} {}", german ? "Disparität" : "disparity",
                         tenths(disparity->min_px), to, tenths(disparity->max_px), tenths(disparity->min_arcmin), to,
                         tenths(disparity->max_arcmin), german ? "Bogenminuten" : "arcmin");
  // One degree is the usual limit (Lambooij, IJsselsteijn, Fortuin & Heynderickx, Journal of
  // Imaging Science and Technology 53 (2009) 030201), after Percival's zone of comfort.
  if (disparity->range_deg() > stereo.comfort_deg) {
    caption += fmt::format("\n{} {:.4g}{}", german ? "unbequem: Disparität über" : "uncomfortable: disparity exceeds",
                           stereo.comfort_deg, german ? "°" : " deg");
  }
  return caption;
}

}  // namespace ergodome
