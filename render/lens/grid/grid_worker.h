#pragma once

#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>

#include "render/lens/grid/grid_builder.h"
#include "render/lens/stations/place_turn.h"

namespace ergodome {

//! A grid that is asked for.
struct GridOrder {
  double spin = 0.0;
  LensPlace place{};
  GridSettings settings{};
};

//! A grid that is finished.
struct GridDelivery {
  GridOrder order;
  LensStation station;
  GridStatistics statistics;
};

//! Builds grids in a thread of its own, for whoever cannot wait for each. An order that has not been begun gives way to a later one.
class GridWorker {
 public:
  GridWorker();
  ~GridWorker();
  GridWorker(const GridWorker&) = delete;
  GridWorker& operator=(const GridWorker&) = delete;

  //! Orders a grid and waits for it, for a time; then gives what has been finished since the last call: this grid, an earlier one, or
  //! none. Rethrows what the building of a grid threw.
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
  long begun_ = 0;      //!< number of the order that is, or was last, in hand
  long delivered_ = 0;  //!< number of the order that the last delivery was for
  std::jthread thread_;
};

}  // namespace ergodome
