#pragma once

#include <vector>

#include "kernels/spacetime/schwarzschild/connection_table.h"

namespace ergodome {

//! Orders that a table may hold: what goes round more often is some 10^-20 of a turn from the edge of the shadow.
inline constexpr int most_connection_orders = 16;

//! Radii that tables reach to [M]; farther out the closed form serves.
inline constexpr double farthest_of_table = 1e6;

//! What a table of connecting rays is for; M = 1. What is given first is Müller, Schulz & Weiskopf's.
struct ConnectionTableSettings {
  double r_nearest = 2.5;            //!< of the points [M], above 2
  double r_farthest = 30.0;          //!< of the points [M]
  double r_observer_nearest = 40.0;  //!< [M], above 2
  double r_observer_farthest = 40.0;
  int rows = 256;     //!< in 1/r
  int columns = 512;  //!< in azimuth, an order
  int orders = 2;     //!< of images: 2 to most_connection_orders
  int layers = 1;     //!< observers, evenly in 1/r: 1 for one, else 4 or more
};

//! Connecting rays of the first orders for one observer's radius or a range of them.
class ConnectionTable {
 public:
  //! Makes it on the processor: milliseconds for an observer. Throws Error for settings that make no table.
  explicit ConnectionTable(const ConnectionTableSettings& settings);

  [[nodiscard]] ConnectionView view() const { return {grid_, nodes_.data()}; }

 private:
  ConnectionGrid grid_{};
  std::vector<ConnectionNode> nodes_;
};

}  // namespace ergodome
