#include "app/commands/accuracy/report_series.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace ergodome {

namespace {

//! Returns the color of a method, which is the same in all plots. Other methods cycle through a few
//! colors.
const char* colour_of(const std::string& method, std::size_t number) {
  constexpr std::array<std::pair<std::string_view, const char*>, 10> known = {{{"conforming grid", "#009e73"},
                                                                               {"quadtree, linear", "#e69f00"},
                                                                               {"quadtree, spline", "#d55e00"},
                                                                               {"quadtree", "#d55e00"},
                                                                               {"direct rays", "#0072b2"},
                                                                               {"taylor", "#56b4e9"},
                                                                               {"cash_karp", "#cc79a7"},
                                                                               {"baseline_rk34", "#8c564b"},
                                                                               {"rk34", "#6a3d9a"},
                                                                               {"closed_form", "#333333"}}};
  constexpr std::array others = {"#0072b2", "#d55e00", "#009e73", "#cc79a7"};
  const auto* const found = std::ranges::find_if(known, [&](const auto& entry) { return entry.first == method; });
  return found != known.end() ? found->second : others[number % others.size()];
}

}  // namespace

std::vector<ReportSeries> series_of(const AccuracyAxis& axis) {
  std::vector<ReportSeries> all;
  for (const Measurement& choice : axis.choices) {
    std::string name = choice.method;
    if (!choice.precision.empty()) {
      name += ", " + choice.precision;
    }
    if (!choice.published.empty()) {
      name += " (" + choice.published + ")";
    }
    auto found = std::ranges::find_if(all, [&](const ReportSeries& series) { return series.name == name; });
    if (found == all.end()) {
      const std::size_t before = all.size();
      all.push_back(
          {static_cast<int>(before) + 1, name, colour_of(choice.method, before), !choice.published.empty(), {}});
      found = all.end() - 1;
    }
    found->choices.push_back(&choice);
  }
  return all;
}

}  // namespace ergodome
