#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "kernels/launch/launch.h"
#include "kernels/launch/parallel_for.h"
#include "kernels/spacetime/trace/trace_rays.h"

// The time of rays at different accuracies. A camera at r = 5 M and a = 0.999 traces rays in all
// directions, by method, precision and tolerance, on all CPU threads. Counters: nanoseconds per ray
// (wall-clock time); million rays per second; error of the sky direction against the most accurate
// Taylor series (median and 99th percentile of the rays that escape); number of rays that did not
// converge.
namespace {

using namespace ergodome;

constexpr int rows = 320;

template <class S>
struct Rays {
  std::vector<S> n[3], sky[3], status;
  explicit Rays(std::size_t count) : status(count) {
    for (int k = 0; k < 3; ++k) {
      n[k].resize(count);
      sky[k].resize(count);
    }
  }
};

//! Returns rays over the whole sphere, in rows of equal area around the outward direction.
//! Neighbors in the array have similar directions, as in pictures.
template <class S>
Rays<S> all_sky() {
  Rays<S> rays(std::size_t{2} * rows * rows);
  std::size_t i = 0;
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < 2 * rows; ++x, ++i) {
      const double z = 1.0 - 2.0 * (y + 0.5) / rows;
      const double across = std::sqrt(1.0 - z * z);
      const double angle = 3.14159265358979 * (x + 0.5) / rows;
      // Directions are rounded to the precision of the trace, so that this rounding counts as an
      // error of the method.
      const double v[3] = {across * std::cos(angle), across * std::sin(angle), z};
      for (std::size_t k = 0; k < 3; ++k) {
        rays.n[k][i] = static_cast<S>(v[k]);
      }
    }
  }
  return rays;
}

template <class S>
RayBatch<S> batch_of(Rays<S>& rays, TraceMethod method, double tolerance) {
  RayBatch<S> batch{};
  batch.camera =
      converted_station<S>(make_camera_station(Spacetime{0.999}, 5.0, 1.5707963267948966, 0.0, ObserverMotion::zamo));
  batch.settings = {tolerance, method == TraceMethod::baseline_rk34 ? 2000 : 20'000};
  batch.method = method;
  batch.count = static_cast<int>(rays.status.size());
  for (int k = 0; k < 3; ++k) {
    batch.direction[k] = rays.n[k].data();
    batch.sky[k] = rays.sky[k].data();
  }
  batch.status = rays.status.data();
  return batch;
}

const Rays<double>& reference() {
  static const Rays<double> exact = [] {
    Rays<double> rays = all_sky<double>();
    launch(Backend::cpu, batch_of(rays, TraceMethod::taylor, 1e-14));
    return rays;
  }();
  return exact;
}

template <class S>
void trace_all_sky(benchmark::State& state, TraceMethod method, double tolerance) {
  const Rays<double>& exact = reference();
  Rays<S> rays = all_sky<S>();
  const RayBatch<S> batch = batch_of(rays, method, tolerance);
  for (auto _ : state) {
    launch(Backend::cpu, batch);
  }
  std::vector<double> errors;
  int lost = 0;
  for (std::size_t i = 0; i < rays.status.size(); ++i) {
    if (exact.status[i] == 0.0) {
      lost += rays.status[i] == S(0) ? 0 : 1;
      if (rays.status[i] == S(0)) {
        errors.push_back(std::hypot(rays.sky[0][i] - exact.sky[0][i], rays.sky[1][i] - exact.sky[1][i],
                                    rays.sky[2][i] - exact.sky[2][i]));
      }
    }
  }
  std::sort(errors.begin(), errors.end());
  const auto count = static_cast<double>(rays.status.size());
  state.counters["ns_per_ray"] =
      benchmark::Counter(count * 1e-9, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  state.counters["Mrays_per_s"] = benchmark::Counter(count * 1e-6, benchmark::Counter::kIsIterationInvariantRate);
  state.counters["error_median"] = errors.empty() ? -1.0 : errors[errors.size() / 2];
  state.counters["error_p99"] = errors.empty() ? -1.0 : errors[errors.size() * 99 / 100];
  state.counters["lost_rays"] = lost;
  state.SetLabel(std::string(name_of(active_instruction_set())) + ", " + std::to_string(thread_count()) + " threads");
}

void register_method(const std::string& name, TraceMethod method, std::initializer_list<double> tolerances,
                     bool narrow) {
  for (const double tolerance : tolerances) {
    char text[32];
    std::snprintf(text, sizeof text, "%.0e", tolerance);
    const std::string row = "rays/" + name + (narrow ? "/float/" : "/double/") + text;
    benchmark::RegisterBenchmark(row.c_str(),
                                 [=](benchmark::State& state) {
                                   if (narrow) {
                                     trace_all_sky<float>(state, method, tolerance);
                                   } else {
                                     trace_all_sky<double>(state, method, tolerance);
                                   }
                                 })
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
  }
}

const bool registered = [] {
  register_method("taylor", TraceMethod::taylor, {1e-4, 1e-5, 3e-6, 1e-6}, true);
  register_method("taylor", TraceMethod::taylor, {1e-4, 1e-6, 1e-8, 1e-12}, false);
  register_method("cash_karp", TraceMethod::cash_karp, {1e-4, 1e-5}, true);
  register_method("cash_karp", TraceMethod::cash_karp, {1e-4, 1e-6, 1e-8}, false);
  register_method("rk34", TraceMethod::rk34, {1e-4, 1e-5}, true);
  register_method("rk34", TraceMethod::rk34, {1e-4, 1e-6}, false);
  register_method("baseline_rk34", TraceMethod::baseline_rk34, {1e-4, 1e-5}, true);
  register_method("baseline_rk34", TraceMethod::baseline_rk34, {1e-4, 1e-6}, false);
  register_method("closed_form", TraceMethod::closed_form, {1e-12}, false);
  return true;
}();

}  // namespace
