#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "kernels/core/angles.h"
#include "kernels/launch/parallel_for.h"
#include "render/published/connection_table.h"

// Benchmarks of connection tables, with the size and the observers of table 2 in Müller, Schulz &
// Weiskopf: observers at 10, 20 and 30 Schwarzschild radii; for each image order, 256 rows (r from
// 2.5 to 30 M) and 512 columns (azimuth φ). Counters: errors against the closed form for 1e5 random
// pairs of points, uniform in 1/r and φ. Also measures single rays in closed form.
namespace {

using namespace ergodome;

constexpr int pair_count = 100'000;

struct Errors {
  std::vector<double> xi = std::vector<double>(pair_count);
  std::vector<double> time = std::vector<double>(pair_count);
};

struct Pair {
  double r, angle;
};

std::vector<Pair> random_pairs(double r_nearest, double r_farthest) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> u(1.0 / r_farthest, 1.0 / r_nearest);
  std::uniform_real_distribution<double> phi(0.0, 2.0 * pi);
  std::vector<Pair> pairs;
  for (int i = 0; i < pair_count; ++i) {
    const double r = 1.0 / u(random);
    pairs.push_back({r, phi(random)});
  }
  return pairs;
}

Errors errors_of(const ConnectionTable& table, const ConnectionTableSettings& settings) {
  const std::vector<Pair> pairs = random_pairs(settings.r_nearest, settings.r_farthest);
  const double r_observer = settings.r_observer_nearest;
  Errors errors;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const ConnectingRay exact = connecting_ray(r_observer, pairs[i].r, pairs[i].angle);
    const SeenPoint read = look_up_connection(table.view(), r_observer, pairs[i].r, pairs[i].angle);
    errors.xi[i] = std::abs(read.xi - exact.xi) * 180.0 / pi;
    errors.time[i] = std::abs(read.travel_time - exact.travel_time);
  }
  std::sort(errors.xi.begin(), errors.xi.end());
  std::sort(errors.time.begin(), errors.time.end());
  return errors;
}

void connection_table(benchmark::State& state) {
  ConnectionTableSettings settings;
  settings.r_observer_nearest = 2.0 * static_cast<double>(state.range(0));
  settings.r_observer_farthest = settings.r_observer_nearest;
  settings.rows = static_cast<int>(state.range(1));
  settings.columns = 2 * settings.rows;
  for (auto _ : state) {
    const ConnectionTable table(settings);
    benchmark::DoNotOptimize(table.view().nodes);
  }
  const Errors errors = errors_of(ConnectionTable(settings), settings);
  state.counters["xi_median_deg"] = errors.xi[pair_count / 2];
  state.counters["xi_max_deg"] = errors.xi.back();
  state.counters["time_median"] = errors.time[pair_count / 2];
  state.counters["time_max"] = errors.time.back();
  state.SetLabel(std::to_string(thread_count()) + " threads");
}

BENCHMARK(connection_table)
    ->ArgNames({"r_obs_rs", "rows"})
    ->ArgsProduct({{10, 20, 30}, {64, 128, 256}})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

void connecting_rays(benchmark::State& state) {
  const std::vector<Pair> pairs = random_pairs(2.5, 30.0);
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(connecting_ray(40.0, pairs[i].r, pairs[i].angle));
    i = i + 1 < pairs.size() ? i + 1 : 0;
  }
}

BENCHMARK(connecting_rays)->Unit(benchmark::kMicrosecond);

}  // namespace
