#include "app/commands/accuracy/report_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <iterator>
#include <map>

#include "app/commands/accuracy/report_numbers.h"
#include "render/accuracy/equal_error.h"

namespace ergodome {

namespace {

struct NamedError {
  double error;
  const char* name;
};

constexpr NamedError pixel_errors[] = {
    {1.0, "one pixel"}, {0.25, "a quarter pixel"}, {0.1, "a tenth of a pixel"}, {0.01, "a hundredth of a pixel"}};

//! Axes of so few choices are told choice by choice.
constexpr std::size_t few_choices = 5;
//! And those of so many, where there is no method that others are compared with.
constexpr std::size_t few_without_base = 9;

//! "A quarter pixel costs 3 ms a frame (...); a tenth of a pixel costs 7 ms (...)." One clause a choice: the finest error that it holds.
std::string cost_sentence(const AccuracyAxis& axis) {
  std::string text;
  for (std::size_t i = 0; i < std::size(pixel_errors); ++i) {
    const Measurement* const choice = cheapest_within(axis, pixel_errors[i].error, FrameCost::ready);
    const bool finer_too =
        i + 1 < std::size(pixel_errors) && cheapest_within(axis, pixel_errors[i + 1].error, FrameCost::ready) == choice;
    if (choice == nullptr || finer_too) {
      continue;
    }
    const std::string unit = text.empty() ? " ms " + axis.time : " ms";
    text += text.empty() ? "" : "; ";
    text += fmt::format("{} costs {}{} ({})", pixel_errors[i].name, short_number(cost_ms(*choice, FrameCost::ready)),
                        unit, choice_name(*choice));
  }
  if (!text.empty()) {
    text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
    text += '.';
  }
  return text;
}

//! "ewa (an ellipse): half of all are right within 1.3 %, 99 of 100 within 68 %; 36 ms a frame."
std::string choice_sentence(const AccuracyAxis& axis, const Measurement& choice) {
  std::string text = fmt::format(
      "{} ({}{}): half of what was compared is right within {}, 99 of 100 within {}; {} ms {}", choice.method,
      choice.setting, choice.published.empty() ? std::string() : ", the method of " + choice.published,
      error_text(axis, choice.error.median), error_text(axis, choice.error.p99),
      short_number(cost_ms(choice, FrameCost::ready)), axis.time);
  if (choice.lost > 0.0) {
    text += fmt::format("; {} % are missing", short_number(100.0 * choice.lost));
  }
  return text + '.';
}

//! "quadtree, spline (the method of VE) takes 4.2 times as long as taylor to be right within a tenth of a pixel ..."
std::string published_sentence(const AccuracyAxis& axis, const EqualErrorRow& row, const NamedError& error) {
  const Measurement* const any = row.choice;
  if (any == nullptr || any->published.empty() || row.ratio.runs == 0) {
    return {};
  }
  return fmt::format("{} (the method of {}) takes {} times as long as {} to be right within {} in 99 of 100 pixels.",
                     row.method, any->published, short_number(row.ratio.median), axis.base, error.name);
}

}  // namespace

std::vector<std::string> axis_sentences(const AccuracyAxis& axis) {
  std::vector<std::string> sentences;
  if (axis.choices.size() <= (axis.base.empty() ? few_without_base : few_choices)) {
    for (const Measurement& choice : axis.choices) {
      sentences.push_back(choice_sentence(axis, choice));
    }
    return sentences;
  }
  const std::string costs = cost_sentence(axis);
  if (!costs.empty()) {
    sentences.push_back(costs);
  }
  if (axis.unit == ErrorUnit::pixels && !axis.base.empty()) {
    const NamedError& error = pixel_errors[2];
    for (const EqualErrorRow& row : compare_at(axis, error.error, FrameCost::ready)) {
      const std::string sentence = published_sentence(axis, row, error);
      if (!sentence.empty()) {
        sentences.push_back(sentence);
      }
    }
  }
  return sentences;
}

std::vector<std::string> accuracy_sentences(const AccuracyReport& report) {
  std::vector<std::string> sentences;
  for (const AccuracyAxis& axis : report.axes) {
    std::string first = axis.title + ": ";
    for (const std::string& sentence : axis_sentences(axis)) {
      sentences.push_back(first + sentence);
      first = "  ";
    }
  }
  return sentences;
}

std::string repeatability_words(const AccuracyReport& report) {
  const double spread = time_spread(report);
  if (spread == 0.0) {
    return "No choice was timed more than once, so nothing is known about how well the times repeat.";
  }
  const std::string measured = fmt::format(
      "the slowest run of a choice took {:.2f} times as long as its quickest (median of all choices; up to {:.2f} "
      "counts "
      "as quiet)",
      spread, busy_time_spread);
  if (!is_too_busy(report)) {
    return fmt::format("The machine was quiet enough to rank methods: {}.", measured);
  }
  return fmt::format(
      "The machine was too busy to rank methods: {}. Which of two methods is faster is not known where their times "
      "differ by less than that. The errors are not affected. Stop other programs and measure again.",
      measured);
}

std::string method_words(const std::string& method) {
  static const std::map<std::string, std::string> words = {
      {"direct rays", "no grid: traces the path of light for every pixel of every frame"},
      {"conforming grid",
       "our own grid: traces light for some thousand directions, laid out around the edge of the shadow, and "
       "interpolates between them for each pixel"},
      {"quadtree, linear", "the grid of Verbraeck & Eisemann, with linear interpolation"},
      {"quadtree, spline", "the grid of Verbraeck & Eisemann, with smooth curves (splines) for interpolation"},
      {"quadtree", "the grid of Verbraeck & Eisemann, with smooth curves (splines) for interpolation"},
      {"taylor", "our own integrator: traces light in long steps, each a power series (Taylor) of ten to twenty terms"},
      {"cash_karp",
       "a Runge-Kutta integrator of fifth order (Cash & Karp), in our equations, which have no singular points"},
      {"rk34", "a Runge-Kutta integrator of third and fourth order, in our equations"},
      {"baseline_rk34",
       "the same integrator in the published equations, which use angles and are singular at the poles"},
      {"closed_form",
       "the path of light as a formula (elliptic functions): slow and exact; the reference for all others"},
      {"stations with derivatives",
       "lenses computed in advance at some positions on the camera's path, with how they change there"},
      {"plain stations", "lenses computed in advance at some positions on the camera's path, and blended in between"},
      {"point", "one look at the map, where the middle of the pixel sees it; details flicker"},
      {"ewa",
       "elliptical weighted average: a mean over the patch of the map that the pixel sees, from smaller copies of it"},
      {"polygon", "the exact mean over the patch of the map that the pixel sees, as a quadrangle"},
      {"physical", "two cameras, one for each eye: what two eyes would see there"},
      {"flat", "one camera; near things are shifted as if space were flat (Hamilton & Polhemus 2010)"},
      {"omni", "omnidirectional stereo: the eyes turn with the direction, for viewers who look around"},
      {"rays", "traces light from every pixel to what it meets"},
      {"polygons", "triangles, whose corners are drawn where their light arrives (Müller, Schulz & Weiskopf)"},
      {"inverse", "finds for every star where on the screen its light arrives"},
      {"gather", "finds for every pixel which stars it sees"}};
  const auto found = words.find(method);
  return found != words.end() ? found->second : std::string();
}

}  // namespace ergodome
