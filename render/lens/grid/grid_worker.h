#pragma once

#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>

#include "render/lens/grid/grid_builder.h"
#include "render/lens/stations/place_turn.h"

// Builds lens grids on a thread.

namespace ergodome {

//! An order for a grid.
struct GridOrder {
  Spacetime spacetime;
  LensPlace place{};
  GridSettings settings{};
};

//! A finished grid.
struct GridDelivery {
  GridOrder order;
  LensStation station;
  GridStatistics statistics;
};

//! Builds grids on its own thread, for callers that cannot wait for each one. A later order
//! replaces one that has not been started.
class GridWorker {
 public:
  GridWorker();
  ~GridWorker();
  GridWorker(const GridWorker&) = delete;
  GridWorker& operator=(const GridWorker&) = delete;

  //! Orders a grid and waits up to `patience_s`. Returns the grid finished since the last call, if
  //! any: this one or an earlier one. Rethrows exceptions from building a grid.
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
  long orders_ = 0;     //!< number of the latest order
  long begun_ = 0;      //!< number of the order that the thread last started
  long delivered_ = 0;  //!< number of the order last delivered
  std::jthread thread_;
};

}  // namespace ergodome
