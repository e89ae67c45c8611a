#pragma once

#include <vector>

#include "kernels/eyes/omni/omni_batches.h"
#include "kernels/lens/grid_build.h"
#include "render/backend/buffer.h"

// Traces the rays of lens grids while they are built.

namespace ergodome {

//! Ratio of a cubic's error in the middle to its error at the inner checks: (u (1 - u))² at 1/2,
//! divided by that at `inner_check`.
inline constexpr float inner_share =
    0.0625F / (inner_check * inner_check * (1.0F - inner_check) * (1.0F - inner_check));

//! Results of checking cells, checks_a_cell values per cell; see CheckBatch.
struct CellChecks {
  std::vector<float> error_px;
  std::vector<float> area_px;
  std::vector<float> gamma_parts;
  std::vector<float> s_parts;
};

//! Traces the rays of a growing grid on the CPU or a GPU. The grid's nodes stay in the memory that
//! the kernels read.
//!
//! Serves one grid at a time and reuses its memory for the next. Rays in double and rays of ODS eyes
//! (OmniCameraOf) are traced on the CPU only.
template <class S, class Camera = CameraStationOf<S>>
class GridTracer {
  using Grid = GridCamera<S, Camera>;

 public:
  explicit GridTracer(Backend backend = Backend::cpu);

  //! Starts a grid without nodes. Copies the edge table of the camera's chart from host memory.
  //! `pixel`: angle of a pixel on the observer's screen [rad].
  void begin(const Grid& camera, const AberrationOf<S>& observer, double pixel);

  //! Traces nodes at (γ [turns], s) and appends them.
  void add_nodes(const std::vector<float>& gamma_turns, const std::vector<float>& s);

  [[nodiscard]] int node_count() const { return node_count_; }

  //! Returns all nodes so far, floats_a_node values each.
  [[nodiscard]] std::vector<float> nodes() const;

  //! Checks cells whose corners are among the nodes so far.
  void check(const std::vector<GridCell>& cells, CellChecks& found);

  //! Returns the nodes at (γ, s) of another camera. Does not change the grid.
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
