#pragma once

#include <cuda_runtime.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <string>
#include <thread>
#include <vector>

#include "kernels/launch/launch_on_cuda.cuh"

// Runs kernels on GPU and CPU, times them and compares the results.
namespace ergodome::gpu_check {

//! An array with a copy on the host and one on the device.
template <class T>
class Twin {
 public:
  explicit Twin(std::size_t count) : host(count) { check_cuda(cudaMalloc(&device_, count * sizeof(T)), "cudaMalloc"); }
  ~Twin() { cudaFree(device_); }
  Twin(const Twin&) = delete;
  Twin& operator=(const Twin&) = delete;

  [[nodiscard]] T* device() const { return device_; }
  void upload() {
    check_cuda(cudaMemcpy(device_, host.data(), host.size() * sizeof(T), cudaMemcpyHostToDevice), "upload");
  }
  [[nodiscard]] std::vector<T> download() const {
    std::vector<T> values(host.size());
    check_cuda(cudaMemcpy(values.data(), device_, values.size() * sizeof(T), cudaMemcpyDeviceToHost), "download");
    return values;
  }

  std::vector<T> host;

 private:
  T* device_ = nullptr;
};

//! Calls functor(i) for all i on CPU threads; the functor is the same source, compiled for the
//! host. Returns the time [ms].
template <class Functor>
double run_on_host_ms(const Functor& functor, int count) {
  const auto start = std::chrono::steady_clock::now();
  const int threads = static_cast<int>(std::thread::hardware_concurrency());
  std::vector<std::thread> workers;
  for (int t = 0; t < threads; ++t) {
    workers.emplace_back([&functor, t, threads, count] {
      for (int i = t; i < count; i += threads) {
        functor(i);
      }
    });
  }
  for (std::thread& worker : workers) {
    worker.join();
  }
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

//! Returns the median time of several launches [ms] from CUDA events, after a warm-up launch.
template <class Launch>
double time_on_device_ms(const Launch& launch) {
  launch();
  cudaEvent_t begin{};
  cudaEvent_t end{};
  check_cuda(cudaEventCreate(&begin), "event");
  check_cuda(cudaEventCreate(&end), "event");
  std::vector<float> times;
  for (int i = 0; i < 7; ++i) {
    check_cuda(cudaEventRecord(begin), "event");
    launch();
    check_cuda(cudaEventRecord(end), "event");
    check_cuda(cudaEventSynchronize(end), "event");
    float time_ms = 0.0F;
    check_cuda(cudaEventElapsedTime(&time_ms, begin, end), "event");
    times.push_back(time_ms);
  }
  cudaEventDestroy(begin);
  cudaEventDestroy(end);
  std::sort(times.begin(), times.end());
  return times[times.size() / 2];
}

template <class Functor>
double run_on_device_ms(const char* name, const Functor& functor, int count) {
  return time_on_device_ms([&] { launch_cuda(name, count, functor); });
}

//! Launches a functor over the pixels of a square image, as pictures do, and returns the time [ms].
template <class Functor>
double run_on_pixels_ms(const char* name, const Functor& functor, int size) {
  return time_on_device_ms([&] { launch_cuda_on_pixels(name, size, size, functor); });
}

//! The difference of two results: the given quantile of |a - b| / max(1, |b|), and whether it is
//! within the tolerance.
struct Comparison {
  double quantile;
  bool good;
};

template <class T>
Comparison compare(const std::vector<T>& device, const std::vector<T>& host, double share, double tolerance) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < host.size(); ++i) {
    const double error =
        std::abs(static_cast<double>(device[i]) - host[i]) / std::max(1.0, std::abs(static_cast<double>(host[i])));
    errors.push_back(std::isnan(error) ? 1e30 : error);
  }
  const auto at = errors.begin() + static_cast<long>(share * static_cast<double>(errors.size() - 1));
  std::nth_element(errors.begin(), at, errors.end());
  return {*at, *at <= tolerance};
}

//! Prints a row of the table; returns whether the comparison was good.
inline bool report(const std::string& name, int count, double device_ms, double host_ms, const Comparison& c) {
  std::printf("%-34s %10d %10.3f %10.1f %9.1f %12.2e %s\n", name.c_str(), count, device_ms, host_ms,
              host_ms / device_ms, c.quantile, c.good ? "good" : "DIFFERS");
  return c.good;
}

bool check_rays();
bool check_pixels();
bool check_grids();
bool check_projections();

}  // namespace ergodome::gpu_check
