#pragma once

#include <vector>

#include "kernels/disk/disk_grid.h"
#include "render/backend/buffer.h"

namespace ergodome {

//! Traces the rays of a disk's grid in the making, on the processor. It serves one grid after the other and keeps its memory from each to the next.
class DiskGridTracer {
 public:
  //! Begins a grid without nodes; the camera's edge table has to outlive its making. `pixel`: angle of a pixel on the observer's screen [rad].
  //! `nearness`: nodes have DiskGrid::nearness, too.
  void begin(const DiskGridCamera& camera, const AberrationOf<float>& observer, double pixel,
             const DiskSpanOnScreen& span, bool nearness = false);

  //! Traces nodes at (γ [turns], s) and appends them.
  void add_nodes(const std::vector<float>& gamma_turns, const std::vector<float>& s);

  [[nodiscard]] int node_count() const { return node_count_; }
  [[nodiscard]] int sets() const { return camera_.pattern ? layer_orders : 1; }

  //! A set of the nodes so far, floats_a_node each.
  [[nodiscard]] std::vector<float> nodes(int set) const { return copied(nodes_[set]); }

  //! The nearness of the nodes so far; empty where it was not asked for.
  [[nodiscard]] std::vector<float> nearness() const { return has_nearness_ ? copied(nearness_) : std::vector<float>(); }

  //! 1/r of an order at a node.
  [[nodiscard]] float u_at(int order, int node) const;

  //! Checks cells between the nodes so far.
  void check(const std::vector<GridCell>& cells);

  //! What that has found, checks_a_cell values a cell; see DiskCheckBatch.
  [[nodiscard]] const float* error_px() const { return error_px_.data(); }
  [[nodiscard]] const float* area_px() const { return area_px_.data(); }
  [[nodiscard]] const float* u(int order) const { return u_[order].data(); }
  [[nodiscard]] const float* width(int order) const { return width_[order].data(); }

 private:
  [[nodiscard]] std::vector<float> copied(const Buffer<float>& set) const;
  void reserve_nodes(int count);

  DiskGridCamera camera_{};
  AberrationOf<float> observer_{};
  float pixel_ = 0.0F;
  DiskSpanOnScreen span_{};
  bool has_nearness_ = false;
  int node_count_ = 0;
  Buffer<float> gamma_turns_;
  Buffer<float> s_;
  Buffer<float> nodes_[layer_orders];
  Buffer<float> nearness_;
  Buffer<GridCell> cells_;
  Buffer<float> error_px_;
  Buffer<float> area_px_;
  Buffer<float> u_[layer_orders];
  Buffer<float> width_[layer_orders];
};

}  // namespace ergodome
