#pragma once

#include <vector>

#include "kernels/eyes/omni/omni_batches.h"
#include "kernels/lens/grid_build.h"
#include "render/backend/buffer.h"

namespace ergodome {

//! What a cubic misses by in its middle, over what it misses by at the inner checks: (u (1 - u))² at 1/2 and at `inner_check`.
inline constexpr float inner_share =
    0.0625F / (inner_check * inner_check * (1.0F - inner_check) * (1.0F - inner_check));

//! What checks of cells say, checks_a_cell values a cell; see CheckBatch.
struct CellChecks {
  std::vector<float> error_px;
  std::vector<float> area_px;
  std::vector<float> gamma_parts;
  std::vector<float> s_parts;
};

//! Traces the rays of grids in the making, on the processor or on a GPU; a grid's nodes stay where the kernels read them.
//!
//! It serves one grid after the other and keeps its memory from each to the next. Rays in double, and those of eyes that turn with the
//! direction (OmniCameraOf), are traced on the processor alone.
template <class S, class Camera = CameraStationOf<S>>
class GridTracer {
  using Grid = GridCamera<S, Camera>;

 public:
  explicit GridTracer(Backend backend = Backend::cpu);

  //! Begins a grid without nodes. The edge table of the camera's chart lies in host memory and is copied. `pixel`: angle of a pixel on
  //! the observer's screen [rad].
  void begin(const Grid& camera, const AberrationOf<S>& observer, double pixel);

  //! Traces nodes at (γ [turns], s) and appends them.
  void add_nodes(const std::vector<float>& gamma_turns, const std::vector<float>& s);

  [[nodiscard]] int node_count() const { return node_count_; }

  //! The nodes so far, floats_a_node each.
  [[nodiscard]] std::vector<float> nodes() const;

  //! Checks cells between the nodes so far.
  void check(const std::vector<GridCell>& cells, CellChecks& found);

  //! The nodes at (γ, s) of another camera; the grid stays as it is.
  std::vector<float> nodes_of(const Grid& camera, const std::vector<float>& gamma_turns, const std::vector<float>& s);

 private:
  Grid placed(const Grid& camera, Buffer<float>& edge) const;
  void trace(const Grid& camera, const std::vector<float>& gamma_turns, const std::vector<float>& s, float* nodes);
  void reserve_nodes(int count);

  Backend backend_;
  Grid camera_{};
  AberrationOf<S> observer_{};
  S pixel_{};
  int node_count_ = 0;
  Buffer<float> edge_;
  Buffer<float> gamma_turns_;
  Buffer<float> s_;
  Buffer<float> nodes_;
  Buffer<GridCell> cells_;
  Buffer<float> error_px_;
  Buffer<float> area_px_;
  Buffer<float> gamma_parts_;
  Buffer<float> s_parts_;
};

}  // namespace ergodome
