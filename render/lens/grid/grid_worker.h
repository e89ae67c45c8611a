#pragma once

#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>

#include "render/lens/grid/grid_builder.h"
#include "render/lens/stations/lens_position.h"

// Builds lens grids on a thread.

namespace ergodome {

//! A request to build a grid.
struct GridOrder {
  Spacetime spacetime;
  LensPosition position{};
  GridSettings settings{};
};

//! A finished grid.
struct GridDelivery {
  GridOrder order;
  LensStation station;
  GridStatistics statistics;
};

//! Builds grids on its own thread, for callers that cannot wait for each grid. A new request
//! replaces an earlier one that has not been started.
class GridWorker {
 public:
  GridWorker();
  ~GridWorker();
  GridWorker(const GridWorker&) = delete;
  GridWorker& operator=(const GridWorker&) = delete;

  //! Requests a grid and waits up to `patience_s` for it. Returns the grid that was finished since
  //! the last call, if any; it may belong to an earlier request. Rethrows exceptions from building
  //! a grid.
  std::optional<GridDelivery> build(const GridOrder& order, double patience_s);

 private:
  void work(const std::stop_token& stop);

  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::condition_variable_any finished_;
  std::optional<GridOrder> order_;
  std::optional<GridDelivery> delivery_;
  std::exception_ptr problem_;
  std::optional<GridOrder> in_hand_;
  long orders_ = 0;     //!< number of the latest request
  long begun_ = 0;      //!< number of the request that the thread last started
  long delivered_ = 0;  //!< number of the request that the thread last finished, or failed to build
  std::jthread thread_;
};

}  // namespace ergodome
