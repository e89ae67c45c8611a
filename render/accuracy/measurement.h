#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "render/accuracy/statistics.h"

// Results of a measurement, and comparison of methods at the same error.

namespace ergodome {

//! Errors over a picture, one per cell of a lattice over it, top row first; NaN where nothing was
//! compared.
struct ErrorMap {
  int width = 0;
  int height = 0;
  std::vector<float> error;
};

//! Measured cost and error of one method with one setting and precision.
struct Measurement {
  std::string method;     //!< for example "conforming grid"
  std::string setting;    //!< for example "budget 0.25 px"
  std::string precision;  //!< "float", "double" or empty
  std::string published;  //!< authors of a published method; empty for this project's own methods

  //! Errors in the unit of the axis.
  ErrorSummary error;
  //! 99th percentile of the error's change from frame to frame, in the same unit.
  std::optional<double> flicker;
  //! Fraction of the compared pixels or star images that the method shows as dark, or not at all.
  double lost = 0.0;
  //! Relative error of the light, if `error` is a displacement.
  std::optional<ErrorSummary> light_error;

  std::vector<double> prepare_ms;  //!< time to prepare a camera position (grids, tables), by run
  //! Time of a frame with prepared data, by run, in the same rounds as `prepare_ms`.
  std::vector<double> frame_ms;
  //! Time of each pass of a frame with prepared data, by name of its work counter (as in `ergodome
  //! plan --measure`).
  std::map<std::string, double> passes_ms;
  std::size_t memory_bytes = 0;           //!< memory of the prepared data
  std::optional<std::size_t> disk_bytes;  //!< size of the prepared data in a trajectory file

  bool best_ready = false;  //!< on the Pareto front of error (p99) and time of a prepared frame
  bool best_anew = false;   //!< on the Pareto front of error and time including preparation

  ErrorMap map;
  //! File name of the picture of the error map, beside the report; empty: none.
  std::string picture;

  //! Returns the times of a frame including preparation, by run [ms].
  [[nodiscard]] std::vector<double> anew_ms() const;
};

//! Unit of errors: pixels of the screen, or light relative to the picture's mean.
enum class ErrorUnit { pixels, light };

//! Returns "px", or "%" for light (an error of 1 is 100 %).
const char* unit_name(ErrorUnit unit);

//! A choice that a show leaves open, such as the lens, with the measured cost and error of each
//! option.
struct AccuracyAxis {
  std::string name;   //!< for example "lens"
  std::string title;  //!< title of the axis, a sentence
  ErrorUnit unit = ErrorUnit::pixels;
  std::string reference;  //!< a sentence that describes the reference of the errors
  //! The method whose time is the base of the comparison at equal error; empty: the cheapest
  //! method.
  std::string base;
  std::vector<Measurement> choices;
  std::string time = "per frame";  //!< what Measurement::frame_ms measures
};

//! A complete measurement.
struct AccuracyReport {
  std::string show;
  std::string title;
  std::string machine;
  std::string date;  //!< time of the measurement, UTC
  int width_px = 0;
  int height_px = 0;
  double pixel_arcmin = 0.0;    //!< angle that the pixel which is the unit of errors subtends
  std::vector<double> times_s;  //!< show times of the measured moments
  int samples = 0;              //!< pixels compared at each moment
  int rounds = 0;
  double took_s = 0.0;
  std::vector<AccuracyAxis> axes;
  std::vector<std::string> notes;  //!< what was omitted, and why
};

//! Returns the ratio of the longest to the shortest time in Measurement::frame_ms, as the median
//! over all measurements with at least two runs. Returns 0 if there are no such measurements. The
//! median is insensitive to single disturbed measurements.
double time_spread(const AccuracyReport& report);

//! Maximum time_spread() for which the machine counts as idle enough to rank methods.
inline constexpr double busy_time_spread = 1.25;

//! Returns whether times vary too much to rank methods.
bool is_too_busy(const AccuracyReport& report);

//! Sets best_ready and best_anew of all measurements of an axis.
void mark_pareto(AccuracyAxis& axis);

//! Returns the axis with a name; nullptr if the report has none.
const AccuracyAxis* find_axis(const AccuracyReport& report, const std::string& name);

//! Selects the time that counts as the cost of a frame.
enum class FrameCost {
  ready,  //!< time of a frame whose camera position is already prepared
  anew    //!< time of a frame including the preparation of its camera position
};

//! Returns the median time of a measured method and setting [ms].
double cost_ms(const Measurement& choice, FrameCost cost);

//! Returns the cheapest measurement whose 99th percentile of errors (p99) is at most `maximum`,
//! among those of `method`, or of all methods if `method` is empty; nullptr if there is none.
const Measurement* cheapest_within(const AccuracyAxis& axis, double maximum, FrameCost cost,
                                   const std::string& method = {});

//! The cheapest measurement of a method at an error limit that applies to all methods.
struct EqualErrorRow {
  std::string method;
  //! The method's cheapest measurement within the error limit; nullptr if none is within it.
  const Measurement* choice = nullptr;
  //! Ratio of the time of `choice` to that of the base method's cheapest measurement, formed in
  //! each round: median and extremes. Empty if the method or the base method has no measurement
  //! within the error limit.
  Spread ratio;
};

//! Compares the methods of an axis at the same error limit `maximum` (p99), in the order of the
//! axis. Uses each method's cheapest precision and setting within the limit.
std::vector<EqualErrorRow> compare_at(const AccuracyAxis& axis, double maximum, FrameCost cost);

}  // namespace ergodome
