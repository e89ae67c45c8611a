// Measures the barrier of a dome of several computers over this machine's loopback, and simulates
// large domes and farms from measured times:
//
//   ergodome_cluster_simulation [FRAME_MS [STARTUP_S]]
//
// FRAME_MS: time of a frame of 8K x 8K on one node (default 12); STARTUP_S: time until a task of a
// film renders its first frame (default 2).

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <queue>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "app/cluster/cluster_codec.h"
#include "app/cluster/cluster_library.h"
#include "app/cluster/cluster_master.h"
#include "app/cluster/cluster_node.h"

namespace ergodome {
namespace {

constexpr std::array node_counts = {1, 2, 4, 6, 8, 12, 16};

double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double quantile(std::vector<double> values, double part) {
  if (values.empty()) {
    return 0.0;
  }
  std::ranges::sort(values);
  return values[std::min(static_cast<std::size_t>(part * static_cast<double>(values.size())), values.size() - 1)];
}

ClusterFrame moving_frame() {
  ClusterFrame frame;
  frame.on_path = true;
  frame.rate = 1.0;
  frame.pose = {20.0, 1.5, 0.25, glm::dquat(1.0, 0.0, 0.0, 0.0), Vector3<double>{0.1, 0.0, 0.2}, false, 0.0};
  frame.before = LensPosition{20.001, 1.5};
  frame.followed_stops = 0.5;
  frame.language = "en";
  frame.size_px = 8192;
  frame.projectors_px = 8192;
  frame.quality = ClusterQuality{0.25, 0, SkyFilter::ewa, 8192};
  return frame;
}

//! Node that is ready at once: what remains is the cost of the barrier.
void run_ready_node(const std::string& name, int port, const ClusterKeys& keys, const std::atomic<bool>& ended) {
  std::string problem;
  const auto channel = cluster_library().connect("127.0.0.1", port, keys, name, problem);
  ClusterNode node(*channel, {name, {"v", "s", "c", "d"}}, seconds_now);
  while (!ended) {
    channel->wait(0.002);
    node.poll();
    if (const auto work = node.take_work(); work && !work->runs_on) {
      node.report_ready(work->frame.number, 1.0);
    }
  }
}

//! Returns the times from the publication of frames until their release [ms].
std::vector<double> barrier_ms(int count) {
  constexpr int port = 27653;
  constexpr int frames = 1000;
  std::string problem;
  ClusterKeys keys;
  if (!cluster_library().make_keys(keys, problem)) {
    fmt::print(stderr, "{}\n", problem);
    std::exit(1);
  }
  std::vector<std::string> names;
  names.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    names.push_back(fmt::format("node{}", i + 1));
  }
  const auto channel = cluster_library().listen("127.0.0.1", port + count, keys, problem);
  ClusterMaster master(*channel, {{"v", "s", "c", "d"}, SwapSync::barrier, names, 1}, seconds_now);
  std::atomic<bool> ended = false;
  std::vector<std::thread> nodes;
  nodes.reserve(names.size());
  for (const std::string& name : names) {
    nodes.emplace_back([&, name] { run_ready_node(name, port + count, keys, ended); });
  }
  const auto all_joined = [&] {
    return std::ranges::all_of(master.nodes(), [](const NodeReport& node) { return node.state == NodeState::joined; });
  };
  const auto show_frame = [&] {
    const double begun_s = seconds_now();
    master.publish(moving_frame());
    while (!master.release()) {
      std::this_thread::sleep_for(std::chrono::microseconds(20));
    }
    return 1e3 * (seconds_now() - begun_s);
  };
  while (!all_joined()) {
    show_frame();
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  std::vector<double> times_ms;
  for (int i = 0; i < frames; ++i) {
    times_ms.push_back(show_frame());
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  ended = true;
  for (std::thread& node : nodes) {
    node.join();
  }
  return times_ms;
}

//! Returns the times of equal pieces of work on this machine, divided by their median: the jitter
//! of its scheduler.
std::vector<double> measured_jitter() {
  constexpr int pieces = 600;
  constexpr int steps = 1'500'000;
  std::vector<double> times;
  double sum = 0.0;
  for (int i = 0; i < pieces; ++i) {
    const double begun_s = seconds_now();
    for (int k = 1; k < steps; ++k) {
      sum += 1.0 / k;
    }
    times.push_back(seconds_now() - begun_s);
  }
  const double median = quantile(times, 0.5);
  for (double& time : times) {
    time /= median;
  }
  return sum > 0.0 ? times : std::vector<double>();
}

double one_of(const std::vector<double>& values, std::mt19937& random) {
  return values[std::uniform_int_distribution<std::size_t>(0, values.size() - 1)(random)];
}

void report_domes(double frame_ms) {
  constexpr int simulated = 20'000;
  constexpr double refresh_ms = 1000.0 / 60.0;
  const std::size_t frame_bytes = encode_cluster(moving_frame()).size();
  const std::size_t other_bytes = encode_cluster(ClusterSwap{1}).size() + encode_cluster(ClusterReady{1, 1.0}).size();
  const std::vector<double> jitter = measured_jitter();
  std::mt19937 random(1);
  fmt::print("jitter of equal work: 90 % below {:.2f}, 99 % below {:.2f} of the median\n", quantile(jitter, 0.9),
             quantile(jitter, 0.99));
  fmt::print(
      "| nodes | bytes a frame, all nodes | barrier, median [ms] | 99 % [ms] | frame, median [ms] | 99 % [ms] | later "
      "than 1/60 s |\n");
  for (const int count : node_counts) {
    const std::vector<double> barrier = barrier_ms(count);
    std::vector<double> frames;
    int late = 0;
    for (int i = 0; i < simulated; ++i) {
      double slowest = 0.0;
      for (int node = 0; node < count; ++node) {
        slowest = std::max(slowest, frame_ms * one_of(jitter, random));
      }
      frames.push_back(slowest + one_of(barrier, random));
      late += frames.back() > refresh_ms ? 1 : 0;
    }
    fmt::print("| {} | {} | {:.2f} | {:.2f} | {:.1f} | {:.1f} | {:.1f} % |\n", count,
               static_cast<std::size_t>(count) * (frame_bytes + other_bytes), quantile(barrier, 0.5),
               quantile(barrier, 0.99), quantile(frames, 0.5), quantile(frames, 0.99), 100.0 * late / simulated);
  }
}

//! Returns the frames that a number of nodes renders in an hour. The scheduler starts one task
//! after the other.
double frames_an_hour(int nodes, int chunk, double frame_s, double startup_s, const std::vector<double>& jitter,
                      std::mt19937& random) {
  constexpr double dispatch_s = 0.18;  // Slurm, measured with empty tasks
  constexpr double hour_s = 3600.0;
  std::priority_queue<double, std::vector<double>, std::greater<>> free_s;
  for (int i = 0; i < nodes; ++i) {
    free_s.push(0.0);
  }
  double next_dispatch_s = 0.0;
  double frames = 0.0;
  while (free_s.top() < hour_s && next_dispatch_s < hour_s) {
    const double begun_s = std::max(free_s.top(), next_dispatch_s);
    free_s.pop();
    next_dispatch_s = begun_s + dispatch_s;
    double taken_s = startup_s;
    for (int i = 0; i < chunk; ++i) {
      taken_s += frame_s * one_of(jitter, random);
    }
    frames += chunk * std::clamp((hour_s - begun_s) / taken_s, 0.0, 1.0);
    free_s.push(begun_s + taken_s);
  }
  return frames;
}

void report_farms(double startup_s) {
  constexpr double frame_s = 4.0;
  const std::vector<double> jitter = measured_jitter();
  std::mt19937 random(2);
  fmt::print(
      "frames an hour, {} s a frame, {} s until the first frame of a task:\n| nodes | chunk 1 | 4 | 16 | 60 | ideal "
      "|\n",
      frame_s, startup_s);
  for (const int nodes : {1, 4, 16, 64, 256}) {
    fmt::print("| {} |", nodes);
    for (const int chunk : {1, 4, 16, 60}) {
      fmt::print(" {:.0f} |", frames_an_hour(nodes, chunk, frame_s, startup_s, jitter, random));
    }
    fmt::print(" {:.0f} |\n", nodes * 3600.0 / frame_s);
  }
}

}  // namespace
}  // namespace ergodome

int main(int count, char** arguments) {
  const double frame_ms = count > 1 ? std::atof(arguments[1]) : 12.0;
  const double startup_s = count > 2 ? std::atof(arguments[2]) : 2.0;
  ergodome::report_domes(frame_ms);
  ergodome::report_farms(startup_s);
}
