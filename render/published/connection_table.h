#pragma once

#include <vector>

#include "kernels/spacetime/schwarzschild/connection_table.h"

// Tables of rays that connect points with an observer around a hole without spin.

namespace ergodome {

//! Maximum number of image orders in a table. Images of higher orders are within about 10^-20 of a
//! turn of the shadow's edge.
inline constexpr int max_connection_orders = 16;

//! Maximum radius in tables [M]. Larger radii are refused; the closed form can be used for them.
inline constexpr double farthest_of_table = 1e6;

//! Ranges and sizes of a table of connecting rays; M = 1. The defaults are those of Müller, Schulz
//! & Weiskopf.
struct ConnectionTableSettings {
  double r_nearest = 2.5;            //!< minimum radius of the points [M], above 2
  double r_farthest = 30.0;          //!< maximum radius of the points [M]
  double r_observer_nearest = 40.0;  //!< minimum radius of the observers [M], above 2
  double r_observer_farthest = 40.0;
  int rows = 256;     //!< number of nodes in 1/r
  int columns = 512;  //!< number of nodes in azimuth, per image order
  int orders = 2;     //!< number of image orders: 2 to max_connection_orders
  int layers = 1;     //!< number of observer radii, evenly spaced in 1/r: 1, or at least 4
};

//! The light rays of the first image orders that connect points with observers at one radius or in
//! a range of radii.
class ConnectionTable {
 public:
  //! Builds the table on the CPU; takes milliseconds per observer radius. Throws Error if the
  //! settings are invalid.
  explicit ConnectionTable(const ConnectionTableSettings& settings);

  [[nodiscard]] ConnectionView view() const { return {grid_, nodes_.data()}; }

 private:
  ConnectionGrid grid_{};
  std::vector<ConnectionNode> nodes_;
};

}  // namespace ergodome
