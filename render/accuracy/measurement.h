#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "render/accuracy/statistics.h"

namespace ergodome {

//! Errors over a picture, one a cell of a lattice, the top row first; NaN where nothing was compared.
struct ErrorMap {
  int width = 0;
  int height = 0;
  std::vector<float> error;
};

//! What one way of making a picture costs, and what it misses by. All of it is measured; nothing is taken from a model.
struct Measurement {
  std::string method;     //!< "conforming grid"
  std::string setting;    //!< "budget 0.25 px"
  std::string precision;  //!< "float", "double" or empty
  std::string published;  //!< whose method it is; empty: our own

  //! In the unit of its axis.
  ErrorSummary error;
  std::optional<double> flicker;  //!< p99 of what the error changes by from a frame to the next, in the same unit
  double lost = 0.0;              //!< part of the compared things that it shows as dark, or not at all
  std::optional<ErrorSummary> light_error;  //!< beside a displacement: of the light, as a part of what is right

  std::vector<double> prepare_ms;  //!< what is made before the first frame at a place, run by run: grids, tables
  std::vector<double> frame_ms;    //!< a frame when that is there, in the same rounds
  std::map<std::string, double> passes_ms;  //!< of one such frame, by what is counted (`ergodome plan --measure`)
  std::size_t memory_bytes = 0;             //!< of what is prepared
  std::optional<std::size_t> disk_bytes;    //!< of it in a trajectory

  bool best_ready = false;  //!< on the Pareto front of error (p99) and time of a frame
  bool best_anew = false;   //!< on that of error and time of a frame with what it needs made anew

  ErrorMap map;
  std::string picture;  //!< file of the map's picture, beside the report; empty: none

  //! Time of a frame with what it needs made anew, run by run [ms].
  [[nodiscard]] std::vector<double> anew_ms() const;
};

//! What errors are counted in: pixels of the screen, or light as a part of the picture's mean.
enum class ErrorUnit { pixels, light };

//! "px", or "%" of 1 = 100 %.
const char* unit_name(ErrorUnit unit);

//! A choice that a show leaves, and what each answer costs.
struct AccuracyAxis {
  std::string name;   //!< "lens"
  std::string title;  //!< a sentence
  ErrorUnit unit = ErrorUnit::pixels;
  std::string reference;  //!< what errors are counted from, a sentence
  std::string base;       //!< the method that others are compared with at equal error; empty: whichever is cheapest
  std::vector<Measurement> choices;
  std::string time = "per frame";  //!< what Measurement::frame_ms is the time of
};

//! The whole of a measurement.
struct AccuracyReport {
  std::string show;
  std::string title;
  std::string machine;
  std::string date;  //!< UTC
  int width_px = 0;
  int height_px = 0;
  double pixel_arcmin = 0.0;    //!< angle of the pixel that errors are counted in
  std::vector<double> times_s;  //!< of the show, where it was looked at
  int samples = 0;              //!< pixels compared at each
  int rounds = 0;
  double took_s = 0.0;
  std::vector<AccuracyAxis> axes;
  std::vector<std::string> notes;  //!< what was left out, and why
};

//! The slowest run of a choice over its quickest, as the median over all choices that were timed at least twice; 0 if none was. By the
//! median a single choice that was disturbed does not count.
double time_spread(const AccuracyReport& report);

//! The largest time_spread() of a machine that is quiet enough to rank methods.
inline constexpr double busy_time_spread = 1.25;

//! Whether times repeated too badly to rank methods by them.
bool is_too_busy(const AccuracyReport& report);

//! Marks both Pareto fronts of an axis.
void mark_pareto(AccuracyAxis& axis);

//! The axis of a name; nullptr where the show has no such choice.
const AccuracyAxis* find_axis(const AccuracyReport& report, const std::string& name);

}  // namespace ergodome
