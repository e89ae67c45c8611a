#pragma once

#include <vector>

#include "kernels/eyes/omni/omni_batches.h"
#include "kernels/lens/grid_build.h"
#include "render/backend/buffer.h"

// Traces the rays of lens grids while they are built.

namespace ergodome {

//! Ratio of a cubic's interpolation error at the middle of a side (u = 1/2) to its error at the
//! inner check points (u = `inner_check`). The error is proportional to (u (1 - u))².
inline constexpr float inner_share =
    0.0625F / (inner_check * inner_check * (1.0F - inner_check) * (1.0F - inner_check));

//! Results of the checks of cells, checks_a_cell values per cell; see CheckBatch.
struct CellChecks {
  std::vector<float> error_px;
  std::vector<float> area_px;
  std::vector<float> gamma_parts;
  std::vector<float> s_parts;
};

//! Traces the rays of a lens grid while it is built, on the CPU or a GPU. The grid's nodes stay in
//! the memory that the kernels read.
//!
//! Works on one grid at a time and reuses its memory for the next. Rays in double and rays of ODS
//! eyes (OmniCameraOf) are traced on the CPU only.
template <class S, class Camera = CameraStationOf<S>>
class GridTracer {
  using Grid = GridCamera<S, Camera>;

 public:
  explicit GridTracer(Backend backend = Backend::cpu);

  //! Starts a grid without nodes. Copies the edge table of the camera's chart from host memory.
  //! `pixel`: angle of a pixel on the observer's screen [rad].
  void begin(const Grid& camera, const AberrationOf<S>& observer, double pixel);

  //! Traces rays at chart positions (γ [turns], s) and appends the results to the grid's nodes.
  void add_nodes(const std::vector<float>& gamma_turns, const std::vector<float>& s);

  [[nodiscard]] int node_count() const { return node_count_; }

  //! Returns all nodes traced so far, floats_a_node values each.
  [[nodiscard]] std::vector<float> nodes() const;

  //! Compares the lens interpolated in cells, whose corners must be nodes traced so far, with rays
  //! traced at the cells' check points; stores the errors in `found`.
  void check(const std::vector<GridCell>& cells, CellChecks& found);

  //! Returns nodes traced at chart positions (γ, s) for another camera. Does not change the grid.
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
