#include <algorithm>

#include "kernels/spacetime/trace/trace_rays_kernel.h"
#include "tests/gpu/harness.cuh"

namespace ergodome::gpu_check {

namespace {

//! Fills `n` with directions all over the sky, which are spaced by the golden angle.
template <class S>
void fill_directions(Twin<S> (&n)[3], int count) {
  for (int i = 0; i < count; ++i) {
    const double z = 1.0 - 2.0 * (i + 0.5) / count;
    const double across = std::sqrt(1.0 - z * z);
    n[0].host[static_cast<std::size_t>(i)] = static_cast<S>(z);
    n[1].host[static_cast<std::size_t>(i)] = static_cast<S>(across * std::cos(2.399963229728653 * i));
    n[2].host[static_cast<std::size_t>(i)] = static_cast<S>(across * std::sin(2.399963229728653 * i));
  }
  for (Twin<S>& axis : n) {
    axis.upload();
  }
}

template <class Tracer, class S>
bool check_method(const char* name, double tolerance, int count) {
  const auto size = static_cast<std::size_t>(count);
  Twin<S> n[3] = {Twin<S>(size), Twin<S>(size), Twin<S>(size)};
  Twin<S> sky[3] = {Twin<S>(size), Twin<S>(size), Twin<S>(size)};
  Twin<S> status(size);
  fill_directions(n, count);
  RayBatch<S> batch{};
  batch.camera = converted_station<S>(make_camera_station(Spacetime{0.999}, 5.0, 1.4, 0.3, ObserverMotion::geodesic));
  batch.settings = {tolerance, 20'000};
  batch.count = count;
  RayBatch<S> on_device = batch;
  for (int i = 0; i < 3; ++i) {
    batch.direction[i] = n[i].host.data();
    batch.sky[i] = sky[i].host.data();
    on_device.direction[i] = n[i].device();
    on_device.sky[i] = sky[i].device();
  }
  batch.status = status.host.data();
  on_device.status = status.device();
  const double device_ms = run_on_device_ms(name, TraceRays<Tracer, S>{on_device}, count);
  const double host_ms = run_on_host_ms(TraceRays<Tracer, S>{batch}, count);
  // Sky directions may differ for one ray in a hundred, because near the edge of the shadow light
  // winds around the hole and amplifies rounding errors. Statuses may differ for one ray in 10,000.
  const double allowed = sizeof(S) == 4 ? 1e-4 : 10.0 * tolerance;
  const bool same_sky = report(std::string("trace_rays ") + name + (sizeof(S) == 4 ? " float" : " double"), count,
                               device_ms, host_ms, compare(sky[0].download(), sky[0].host, 0.99, allowed));
  return same_sky && compare(status.download(), status.host, 0.9999, 0.0).good;
}

}  // namespace

bool check_rays() {
  bool good = check_method<TraceByTaylor, float>("taylor", 1e-6, 1 << 22);
  good = check_method<TraceByTaylor, double>("taylor", 1e-12, 1 << 20) && good;
  good = check_method<TraceByRungeKutta<CashKarp>, float>("cash_karp", 1e-5, 1 << 20) && good;
  good = check_method<TraceByRungeKutta<CashKarp>, double>("cash_karp", 1e-8, 1 << 18) && good;
  good = check_method<TraceByRungeKutta<RungeKutta34>, double>("rk34", 1e-6, 1 << 18) && good;
  good = check_method<TraceByBaseline, double>("baseline_rk34", 1e-4, 1 << 18) && good;
  return check_method<TraceByClosedForm, double>("closed_form", 1e-11, 1 << 18) && good;
}

}  // namespace ergodome::gpu_check
