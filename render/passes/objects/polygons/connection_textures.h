#pragma once

#include <memory>
#include <vector>

#include "kernels/spacetime/schwarzschild/connection_table.h"

namespace ergodome {

//! Radii of points [M].
struct RadialRange {
  double nearest;
  double farthest;

  bool operator==(const RadialRange&) const = default;
};

//! The range, a little wider, that tables are made for: one of few, so that objects may move without another table. It depends on nothing that was
//! drawn before.
RadialRange table_range(const RadialRange& range);

//! A table of connecting rays in the current OpenGL context: nodes of ConnectionView as the texels, azimuth along the rows; one layer for an observer,
//! four for a range of their radii.
class ConnectionTexture {
 public:
  ConnectionTexture(const RadialRange& observers, const RadialRange& range, int orders);
  ~ConnectionTexture();
  ConnectionTexture(const ConnectionTexture&) = delete;
  ConnectionTexture& operator=(const ConnectionTexture&) = delete;

  [[nodiscard]] unsigned name() const { return texture_; }
  [[nodiscard]] const ConnectionGrid& grid() const { return grid_; }
  [[nodiscard]] bool serves(const RadialRange& observers, const RadialRange& range, int orders) const;

 private:
  RadialRange observers_;
  RadialRange range_;
  ConnectionGrid grid_{};
  unsigned texture_ = 0;
};

//! The few tables that are in use: of each eye and of the light. What has gone longest without is let go first.
class ConnectionTextures {
 public:
  //! The table of observers, or of a light, for points in a range and images of some orders, two or more; made where there is none yet.
  const ConnectionTexture& table(const RadialRange& observers, const RadialRange& points, int orders);

 private:
  std::vector<std::unique_ptr<ConnectionTexture>> tables_;  //!< used last, last
};

}  // namespace ergodome
