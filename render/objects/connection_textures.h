#pragma once

#include <memory>
#include <vector>

#include "kernels/schwarzschild/connection_table.h"

namespace ergodome {

//! Radii of points [M].
struct RadialRange {
  double nearest;
  double farthest;
};

//! The range, a little wider, that tables are made for: one of few, so that objects may move without another table. It depends on nothing that was
//! drawn before.
RadialRange table_range(const RadialRange& range);

//! A table of connecting rays in the current OpenGL context: nodes of ConnectionView as the texels, azimuth along the rows.
class ConnectionTexture {
 public:
  ConnectionTexture(double r_observer, const RadialRange& range, int orders);
  ~ConnectionTexture();
  ConnectionTexture(const ConnectionTexture&) = delete;
  ConnectionTexture& operator=(const ConnectionTexture&) = delete;

  [[nodiscard]] unsigned name() const { return texture_; }
  [[nodiscard]] const ConnectionGrid& grid() const { return grid_; }
  [[nodiscard]] double r_observer() const { return r_observer_; }
  [[nodiscard]] bool serves(double r_observer, const RadialRange& range, int orders) const;

 private:
  double r_observer_;
  RadialRange range_;
  ConnectionGrid grid_{};
  unsigned texture_ = 0;
};

//! The few tables that are in use: of each eye and of the light. What has gone longest without is let go first.
class ConnectionTextures {
 public:
  //! The table of an observer, or of a light, for points in a range and images of some orders, two or more; made where there is none yet.
  const ConnectionTexture& table(double r_observer, const RadialRange& points, int orders);

 private:
  std::vector<std::unique_ptr<ConnectionTexture>> tables_;  //!< used last, last
};

}  // namespace ergodome
