#include "kernels/launch/launch.h"
#include "kernels/launch/run_on_cpu.h"

namespace ergodome {

void trace_disk_nodes(const DiskNodeBatch& batch) {
  static WorkCounter counter("trace_disk_nodes");
  const WorkScope work(counter, batch.count);
  run_on_cpu(active_table().trace_disk_nodes, batch, batch.count, active_table().lanes_float, grid_grain);
  finish(counter, Backend::cpu, batch);
}

void check_disk_cells(const DiskCheckBatch& batch) {
  static WorkCounter counter("check_disk_cells");
  const WorkScope work(counter, batch.count);
  run_on_cpu(active_table().check_disk_cells, batch, batch.count, active_table().lanes_float, grid_grain);
  finish(counter, Backend::cpu, batch);
}

void check_disk_grid(const DiskGridCheckBatch& batch) {
  static WorkCounter counter("check_disk_grid");
  const WorkScope work(counter, batch.count);
  run_on_cpu(active_table().check_disk_grid, batch, batch.count, active_table().lanes_float, grid_grain);
  finish(counter, Backend::cpu, batch);
}

const char* disk_look_up_name(DiskDrawing disk) {
  return disk == DiskDrawing::pattern ? "look_up_disk, pattern" : "look_up_disk";
}

void look_up_disk(const DiskLookUpBatch& batch) {
  const PixelBatch& image = batch.near_field.pixels;
  const int pixels = image.row_count * image.projection.width_px;
  WorkCounter& counter = work_counter(disk_look_up_name(batch.near_field.drawing));
  const WorkScope work(counter, pixels);
  run_on_cpu(active_table().look_up_disk, batch, pixels, active_table().lanes_float);
  finish(counter, Backend::cpu, batch.near_field);
}

}  // namespace ergodome
