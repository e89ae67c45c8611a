#pragma once

#include <memory>
#include <vector>

#include "kernels/spacetime/schwarzschild/connection_table.h"

namespace ergodome {

//! Range of radii of points [M].
struct RadialRange {
  double nearest;
  double farthest;

  bool operator==(const RadialRange&) const = default;
};

//! Returns the range of radii for which a table is computed: `range`, extended inward to one of a
//! few radii and outward to a power of two, so that objects can move without a new table. The
//! result does not depend on earlier pictures.
RadialRange table_range(const RadialRange& range);

//! A table of connecting rays as a texture in the current OpenGL context. Texels are nodes of
//! ConnectionView, with the azimuth along rows. There is one layer for a single observer radius,
//! and four for a range.
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

//! Cache of the tables in use, for each eye and the light. Evicts the least recently used.
class ConnectionTextures {
 public:
  //! Returns the table for observers (or a light) in a range of radii and points in a range, with
  //! `orders` image orders; callers ask for at least two. Creates it if necessary.
  const ConnectionTexture& table(const RadialRange& observers, const RadialRange& points, int orders);

 private:
  std::vector<std::unique_ptr<ConnectionTexture>> tables_;  //!< most recently used last
};

}  // namespace ergodome
