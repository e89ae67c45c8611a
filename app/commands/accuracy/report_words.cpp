#include "app/commands/accuracy/report_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iterator>
#include <map>

#include "render/accuracy/measurement.h"

namespace ergodome {

std::string short_number(double value) {
  if (!std::isfinite(value)) {
    return "-";
  }
  const double size = std::abs(value);
  if (size == 0.0) {
    return "0";
  }
  if (size >= 9.995) {
    return size < 99'999.5 ? fmt::format("{:.0f}", value) : fmt::format("{:.1e}", value);
  }
  return size >= 0.9995 ? fmt::format("{:.1f}", value) : fmt::format("{:.2g}", value);
}

std::string error_number(const AccuracyAxis& axis, double error) {
  // Below a millionth of a percent, light differs only by the rounding of floats.
  const bool none = axis.unit == ErrorUnit::light && error < 1e-8;
  return short_number(none ? 0.0 : axis.unit == ErrorUnit::light ? 100.0 * error : error);
}

std::string error_text(const AccuracyAxis& axis, double error) {
  std::string text = error_number(axis, error);
  text += axis.unit == ErrorUnit::light ? " %" : " px";
  return text;
}

std::string spread_text(const Spread& spread) {
  return fmt::format("{} ({} to {})", short_number(spread.median), short_number(spread.minimum),
                     short_number(spread.maximum));
}

std::string bytes_text(std::size_t bytes) {
  const auto number = static_cast<double>(bytes);
  return number < 1e6 ? fmt::format("{:.0f} kB", 1e-3 * number) : fmt::format("{:.1f} MB", 1e-6 * number);
}

std::string choice_name(const Measurement& choice) {
  std::string name = choice.method;
  for (const std::string* const part : {&choice.setting, &choice.precision}) {
    if (!part->empty()) {
      name += ", ";
      name += *part;
    }
  }
  return name;
}

namespace {

struct NamedError {
  double error;
  const char* name;
};

constexpr NamedError pixel_errors[] = {
    {1.0, "one pixel"}, {0.25, "a quarter pixel"}, {0.1, "a tenth of a pixel"}, {0.01, "a hundredth of a pixel"}};

//! Axes with at most this many choices get one sentence per choice.
constexpr std::size_t few_choices = 5;
//! Axes without a base method (AccuracyAxis::base) get one sentence per choice if they have at most
//! this many choices.
constexpr std::size_t few_without_base = 9;

//! Returns what the errors in `pixel_errors` cost, with the cheapest choice within each: "errors up
//! to a quarter pixel cost 3 ms per frame (...); ...". If one choice is the cheapest within
//! consecutive errors, only the smallest of these is named. Empty if no choice is within any.
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
    text += fmt::format("errors up to {} cost {}{} ({})", pixel_errors[i].name,
                        short_number(cost_ms(*choice, FrameCost::ready)), unit, choice_name(*choice));
  }
  if (!text.empty()) {
    text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
    text += '.';
  }
  return text;
}

//! Returns the median and 99 % error of a choice, its frame time, and the share of missing samples,
//! if any, as a sentence.
std::string choice_sentence(const AccuracyAxis& axis, const Measurement& choice) {
  std::string text = fmt::format(
      "{} ({}{}): the error is at most {} in half of the samples and at most {} in 99 %; {} ms {}", choice.method,
      choice.setting, choice.published.empty() ? std::string() : ", the method of " + choice.published,
      error_text(axis, choice.error.median), error_text(axis, choice.error.p99),
      short_number(cost_ms(choice, FrameCost::ready)), axis.time);
  if (choice.lost > 0.0) {
    text += fmt::format("; {} % of the samples are missing", short_number(100.0 * choice.lost));
  }
  return text + '.';
}

//! Compares a published method with the base method at equal error: "quadtree, spline (the method
//! of VE) takes 4.2 times as long as taylor for errors of at most ...". Empty if the method is not
//! a published one, if it never reaches the error, or if there is no ratio of times.
std::string published_sentence(const AccuracyAxis& axis, const EqualErrorRow& row, const NamedError& error) {
  const Measurement* const any = row.choice;
  if (any == nullptr || any->published.empty() || row.ratio.runs == 0) {
    return {};
  }
  return fmt::format("{} (the method of {}) takes {} times as long as {} for errors of at most {}.", row.method,
                     any->published, short_number(row.ratio.median), axis.base, error.name);
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
    return "No choice was timed more than once, so the repeatability of the times is unknown.";
  }
  const std::string measured = fmt::format(
      "the slowest run of a choice took {:.2f} times as long as its fastest run (median of all choices; the limit is "
      "{:.2f})",
      spread, busy_time_spread);
  if (!is_too_busy(report)) {
    return fmt::format("The machine was quiet enough to rank methods: {}.", measured);
  }
  return fmt::format(
      "The machine was too busy to rank methods: {}. Where the times of two methods differ by less than this "
      "factor, it is unknown which is faster. The errors are not affected. Stop other programs and measure again.",
      measured);
}

std::string method_words(const std::string& method) {
  static const std::map<std::string, std::string> words = {
      {"direct rays", "traces the light of every pixel in every frame, without a grid"},
      {"conforming grid",
       "Ergodome's grid: traces light in some thousand directions, arranged around the edge of the shadow, and "
       "interpolates between them for each pixel"},
      {"quadtree, linear", "the grid of Verbraeck & Eisemann, with linear interpolation"},
      {"quadtree, spline", "the grid of Verbraeck & Eisemann, with smooth curves (splines) for interpolation"},
      {"quadtree", "the grid of Verbraeck & Eisemann, with smooth curves (splines) for interpolation"},
      {"taylor", "Ergodome's integrator: traces light in long steps, each a Taylor series of ten to twenty terms"},
      {"cash_karp",
       "a fifth-order Runge-Kutta integrator (Cash & Karp), with Ergodome's equations, which have no singularities"
       " at the poles"},
      {"rk34", "a Runge-Kutta integrator of third and fourth order, with Ergodome's equations"},
      {"baseline_rk34",
       "a Runge-Kutta integrator of third and fourth order, with the published equations in polar angles, which are "
       "singular at the poles"},
      {"closed_form",
       "computes the path of light from a formula (elliptic functions): slow and exact; the reference for all others"},
      {"stations with derivatives",
       "lenses computed in advance at some positions on the camera path (stations), with their rates of change"},
      {"plain stations",
       "lenses computed in advance at some positions on the camera path (stations), and blended between them"},
      {"point", "one sample of the sky map, at the center of the pixel; details flicker"},
      {"ewa",
       "elliptical weighted average: the mean over the patch of the sky map that the pixel sees, from smaller "
       "copies of the map"},
      {"polygon", "the exact mean over the patch of the sky map that the pixel sees, taken as a quadrilateral"},
      {"physical", "two cameras, one for each eye: what two real eyes would see"},
      {"flat", "one camera; near things are shifted as if space were flat (Hamilton & Polhemus)"},
      {"omni", "omnidirectional stereo (ODS): the eyes turn with the viewing direction, for viewers who look around"},
      {"rays", "traces the light of every pixel back to what emits it"},
      {"polygons", "draws triangles, with their corners where their light arrives (Müller, Schulz & Weiskopf)"},
      {"inverse", "finds, for every star, where its light arrives on the screen"},
      {"gather", "finds, for every pixel, the stars that it sees"}};
  const auto found = words.find(method);
  return found != words.end() ? found->second : std::string();
}

}  // namespace ergodome
