#include "render/lens/grid/grid_worker.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace ergodome {

namespace {

bool same(const GridOrder& a, const GridOrder& b) {
  return a.spacetime == b.spacetime && same_position(a.position, b.position) && a.settings.pixel == b.settings.pixel &&
         a.settings.budget_px == b.settings.budget_px;
}

}  // namespace

GridWorker::GridWorker() : thread_([this](const std::stop_token& stop) { work(stop); }) {}

GridWorker::~GridWorker() {
  thread_.request_stop();
  wake_.notify_all();
}

std::optional<GridDelivery> GridWorker::build(const GridOrder& order, double patience_s) {
  std::unique_lock lock(mutex_);
  // If the same grid is already being built, waits for that instead of requesting it again.
  long mine = begun_;
  if (!(in_hand_ && same(*in_hand_, order))) {
    order_ = order;
    mine = ++orders_;
    wake_.notify_all();
  }
  finished_.wait_for(lock, std::chrono::duration<double>(std::min(patience_s, 1e6)),
                     [&] { return delivered_ >= mine || problem_; });
  if (problem_) {
    std::rethrow_exception(std::exchange(problem_, nullptr));
  }
  return std::exchange(delivery_, std::nullopt);
}

void GridWorker::work(const std::stop_token& stop) {
  GridTracer<float> tracer;
  std::unique_lock lock(mutex_);
  while (wake_.wait(lock, stop, [this] { return order_.has_value(); })) {
    GridDelivery made{*std::exchange(order_, std::nullopt), {}, {}};
    begun_ = orders_;
    in_hand_ = made.order;
    lock.unlock();
    std::exception_ptr problem;
    try {
      made.station = build_lens_station(made.order.spacetime, made.order.position.r, made.order.position.theta,
                                        made.order.settings, &made.statistics, &tracer);
    } catch (...) {
      problem = std::current_exception();
    }
    lock.lock();
    in_hand_.reset();
    delivered_ = begun_;
    problem_ = problem;
    if (!problem) {
      delivery_ = std::move(made);
    }
    finished_.notify_all();
  }
}

}  // namespace ergodome
