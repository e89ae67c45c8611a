#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "render/accuracy/statistics.h"

// Results of a measurement, and comparison of methods at the same error.

namespace ergodome {

//! Errors over a picture, one per cell of a lattice, top row first; NaN where nothing was compared.
struct ErrorMap {
  int width = 0;
  int height = 0;
  std::vector<float> error;
};

//! Measured cost and error of one way to make a picture.
struct Measurement {
  std::string method;     //!< for example "conforming grid"
  std::string setting;    //!< for example "budget 0.25 px"
  std::string precision;  //!< "float", "double" or empty
  std::string published;  //!< authors of the method; empty: this project

  //! In the unit of its axis.
  ErrorSummary error;
  //! p99 of the error's change from frame to frame, in the same unit.
  std::optional<double> flicker;
  //! Fraction of the compared things that it shows as dark, or not at all.
  double lost = 0.0;
  //! In addition to a displacement: relative error of the light.
  std::optional<ErrorSummary> light_error;

  std::vector<double> prepare_ms;  //!< time to prepare a camera position (grids, tables), by run
  std::vector<double> frame_ms;    //!< time of a frame with prepared data, in the same rounds
  //! Of one such frame, by work counter (`ergodome plan --measure`).
  std::map<std::string, double> passes_ms;
  std::size_t memory_bytes = 0;           //!< of the prepared data
  std::optional<std::size_t> disk_bytes;  //!< of the prepared data in a trajectory

  bool best_ready = false;  //!< on the Pareto front of error (p99) and time of a prepared frame
  bool best_anew = false;   //!< on the Pareto front of error and time including preparation

  ErrorMap map;
  std::string picture;  //!< image file of the map, beside the report; empty: none

  //! Returns the times of a frame including preparation, by run [ms].
  [[nodiscard]] std::vector<double> anew_ms() const;
};

//! Unit of errors: pixels of the screen, or light relative to the picture's mean.
enum class ErrorUnit { pixels, light };

//! Returns "px", or "%" of 1 = 100 %.
const char* unit_name(ErrorUnit unit);

//! A choice that a show leaves open, and the cost of each option.
struct AccuracyAxis {
  std::string name;   //!< for example "lens"
  std::string title;  //!< a sentence
  ErrorUnit unit = ErrorUnit::pixels;
  std::string reference;  //!< what errors are measured against, a sentence
  //! The method with which others are compared at equal error; empty: the cheapest.
  std::string base;
  std::vector<Measurement> choices;
  std::string time = "per frame";  //!< what Measurement::frame_ms measures
};

//! A complete measurement.
struct AccuracyReport {
  std::string show;
  std::string title;
  std::string machine;
  std::string date;  //!< UTC
  int width_px = 0;
  int height_px = 0;
  double pixel_arcmin = 0.0;    //!< angle of the pixel that is the unit of errors
  std::vector<double> times_s;  //!< show times of the moments
  int samples = 0;              //!< pixels compared at each moment
  int rounds = 0;
  double took_s = 0.0;
  std::vector<AccuracyAxis> axes;
  std::vector<std::string> notes;  //!< what was omitted, and why
};

//! Returns the slowest run of a choice over its fastest, as the median over all choices with at
//! least two runs; 0 if there is none. The median is insensitive to single disturbed choices.
double time_spread(const AccuracyReport& report);

//! Maximum time_spread() of a machine that is idle enough to rank methods.
inline constexpr double busy_time_spread = 1.25;

//! Returns whether times vary too much to rank methods.
bool is_too_busy(const AccuracyReport& report);

//! Marks both Pareto fronts of an axis.
void mark_pareto(AccuracyAxis& axis);

//! Returns the axis with a name; nullptr if the show has none.
const AccuracyAxis* find_axis(const AccuracyReport& report, const std::string& name);

//! Which time counts as cost.
enum class FrameCost {
  ready,  //!< a frame whose prepared data exist
  anew    //!< a frame including the preparation
};

//! Returns the median time of a choice [ms].
double cost_ms(const Measurement& choice, FrameCost cost);

//! Returns the cheapest choice whose error is at most `most` for 99 % (p99), among those of
//! `method`, or of all methods if it is empty; nullptr if there is none.
const Measurement* cheapest_within(const AccuracyAxis& axis, double most, FrameCost cost,
                                   const std::string& method = {});

//! A method at an error limit that applies to all methods.
struct EqualErrorRow {
  std::string method;
  //! Its cheapest choice within the limit; nullptr: none that was measured.
  const Measurement* choice = nullptr;
  //! Of its time to that of the base method, by round; without a base it has no runs.
  Spread ratio;
};

//! Compares the methods of an axis at the same error (p99), in the order of the axis; each with its
//! cheapest precision and setting.
std::vector<EqualErrorRow> compare_at(const AccuracyAxis& axis, double most, FrameCost cost);

}  // namespace ergodome
