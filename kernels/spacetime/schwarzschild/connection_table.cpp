#include "kernels/spacetime/schwarzschild/connection_table.h"

#include "kernels/launch/parallel_for.h"
#include "kernels/launch/work_counter.h"
#include "kernels/spacetime/schwarzschild/connection_table_kernel.h"

namespace ergodome {

namespace {

template <class Functor>
void run(const ConnectionBatch& batch, int count, int grain) {
  parallel_for(count, grain, [&](int begin, int end) {
    const Functor functor{batch};
    for (int index = begin; index < end; ++index) {
      functor(index);
    }
  });
}

}  // namespace

void make_connection_table(const ConnectionBatch& batch) {
  const ConnectionGrid& grid = batch.grid;
  const int nodes = grid.layers * grid.rows * (grid.columns + 1);
  static WorkCounter counter("make_connection_table");
  const WorkScope work(counter, nodes);
  run<SolveConnectionFan>(batch, grid.layers * grid.fan_rows * fan_columns(grid), 16);
  run<SpreadConnectionRows>(batch, grid.layers * grid.rows * fan_columns(grid), 256);
  run<FillConnectionNodes>(batch, nodes, 4096);
}

}  // namespace ergodome
