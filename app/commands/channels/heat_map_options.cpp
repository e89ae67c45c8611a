#include "app/commands/channels/heat_map_options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

#include "app/cli/option_checks.h"
#include "app/cli/usage_error.h"
#include "content/show/stereo_eyes.h"
#include "render/lens/lens_source.h"

namespace ergodome {

namespace {

//! Names of ViewMode, in its order.
constexpr std::array view_mode_names = {"sky", "steps", "error", "order", "g", "magnification"};

//! Names of --method, and their methods.
constexpr std::array method_names = {"taylor", "rk34", "cash_karp", "baseline_rk34"};
constexpr std::array trace_methods = {TraceMethod::taylor, TraceMethod::rk34, TraceMethod::cash_karp,
                                      TraceMethod::baseline_rk34};

//! Parses a number. Returns whether the whole text is a number.
bool is_number(std::string_view text, double& number) {
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), number);
  return problem == std::errc() && end == text.data() + text.size();
}

}  // namespace

void add_view_option(CLI::App& command, std::string& view) {
  command.add_option("--view", view, "sky, or a heat map: steps, error, order, g, magnification")
      ->check(one_of(view_mode_names))
      ->capture_default_str();
}

void add_method_option(CLI::App& command, std::string& method) {
  command.add_option("--method", method, "integrator for --view steps and error")->check(one_of(method_names));
}

ViewMode view_mode(const std::string& name) {
  return static_cast<ViewMode>(std::ranges::find(view_mode_names, name) - view_mode_names.begin());
}

std::optional<ViewRange> view_range(const std::string& text, ViewMode mode, bool logarithmic_steps) {
  if (text.empty()) {
    return std::nullopt;
  }
  const std::string option = "--view-range " + text;
  if (mode == ViewMode::sky) {
    throw UsageError(option, "applies only to heat maps, not to the sky", "add --view, for instance --view g");
  }
  const std::size_t colon = text.find(':');
  ViewRange range{};
  const bool parsed = colon != std::string::npos && is_number(std::string_view(text).substr(0, colon), range.low) &&
                      is_number(std::string_view(text).substr(colon + 1), range.high);
  if (!parsed || !std::isfinite(range.low) || !std::isfinite(range.high) || !(range.low < range.high)) {
    throw UsageError(option, "is not a range", "write MIN:MAX with MIN below MAX, for instance 0.5:2");
  }
  if (heat_range(mode, logarithmic_steps).logarithmic && !(range.low > 0.0)) {
    throw UsageError(option, "starts at 0 or below, but this view has a logarithmic scale", "choose a minimum above 0");
  }
  return range;
}

std::optional<TraceMethod> follow_method(const std::string& name, const std::string& view, const Show& show) {
  if (name.empty()) {
    return std::nullopt;
  }
  if (!follows_rays(view_mode(view))) {
    throw UsageError("--method " + name, "applies only to heat maps of steps and errors",
                     "add --view steps or --view error");
  }
  if (has_camera_per_direction(show.stereo)) {
    throw UsageError("--method " + name, "traces rays of one camera, but stereo model omni has a camera for each pixel",
                     "add --stereo mono");
  }
  return trace_methods[static_cast<std::size_t>(std::ranges::find(method_names, name) - method_names.begin())];
}

}  // namespace ergodome
