#pragma once

#include <vector>

#include "kernels/disk/disk_grid.h"
#include "render/backend/buffer.h"

namespace ergodome {

//! Traces the rays of disk grids while they are built, on the CPU. Serves one grid after another
//! and reuses its memory.
class DiskGridTracer {
 public:
  //! Begins a grid without nodes. The camera's edge table must stay valid until the grid is
  //! complete. `pixel`: angle of a pixel on the observer's screen [rad]. `nearness`: also computes
  //! DiskGrid::nearness.
  void begin(const DiskGridCamera& camera, const AberrationOf<float>& observer, double pixel,
             const DiskSpanOnScreen& span, bool nearness = false);

  //! Traces rays at chart positions (γ [turns], s) and appends the results to the grid's nodes.
  void add_nodes(const std::vector<float>& gamma_turns, const std::vector<float>& s);

  [[nodiscard]] int node_count() const { return node_count_; }
  [[nodiscard]] int sets() const { return camera_.pattern ? layer_orders : 1; }

  //! Returns one set of the nodes traced so far (DiskStation::NodeSets), floats_a_node values each.
  [[nodiscard]] std::vector<float> nodes(int set) const { return copied(nodes_[set]); }

  //! Returns DiskGrid::nearness of the nodes traced so far; empty if it is not computed.
  [[nodiscard]] std::vector<float> nearness() const { return has_nearness_ ? copied(nearness_) : std::vector<float>(); }

  //! Returns 1/r at the crossing of an order, at a node.
  [[nodiscard]] float u_at(int order, int node) const;

  //! Traces the check rays of cells whose corners are among the nodes traced so far.
  void check(const std::vector<GridCell>& cells);

  //! Results of the last check(), checks_a_cell values per cell; see DiskCheckBatch.
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
