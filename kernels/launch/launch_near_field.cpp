#include "kernels/launch/launch.h"
#include "kernels/launch/launch_cuda.h"
#include "kernels/launch/run_on_cpu.h"

namespace ergodome {

const char* near_field_name(DiskDrawing disk, bool shells) {
  constexpr const char* names[3][2] = {{nullptr, "draw_shells"},
                                       {"draw_disk", "draw_shells, disk"},
                                       {"draw_disk, pattern", "draw_shells, disk, pattern"}};
  return names[static_cast<int>(disk)][shells ? 1 : 0];
}

void draw_near_field(Backend backend, const NearFieldBatch& batch) {
  const char* const name = near_field_name(batch.drawing, batch.shells.count > 0);
  if (name == nullptr) {
    return;
  }
  const int pixels = batch.pixels.row_count * batch.pixels.projection.width_px;
  WorkCounter& counter = work_counter(name);
  const WorkScope work(counter, pixels);
  if (backend == Backend::cuda) {
    draw_near_field_cuda(batch);
  } else {
    run_on_cpu(active_table().draw_near_field, batch, pixels, active_table().lanes_float);
  }
  finish(counter, backend, batch);
}

const char* flat_eyes_name(DiskDrawing disk, bool shells) {
  constexpr const char* names[2][2] = {{nullptr, "draw_flat_eyes, shells"},
                                       {"draw_flat_eyes, disk", "draw_flat_eyes, disk, shells"}};
  return names[disk == DiskDrawing::none ? 0 : 1][shells ? 1 : 0];
}

void draw_flat_eyes(Backend backend, const FlatEyeBatch& batch) {
  const NearFieldBatch& scene = batch.near_field;
  const char* const name = flat_eyes_name(scene.drawing, scene.shells.count > 0);
  if (name == nullptr) {
    return;
  }
  const int pixels = scene.pixels.row_count * scene.pixels.projection.width_px;
  WorkCounter& counter = work_counter(name);
  const WorkScope work(counter, pixels);
  if (backend == Backend::cuda) {
    draw_flat_eyes_cuda(batch);
  } else {
    run_on_cpu(active_table().draw_flat_eyes, batch, pixels, active_table().lanes_float);
  }
  finish(counter, backend, scene);
}

const char* flat_look_up_name(DiskDrawing disk) {
  return disk == DiskDrawing::pattern ? "look_up_flat_eyes, pattern" : "look_up_flat_eyes";
}

void look_up_flat_eyes(const FlatEyeLookUpBatch& batch) {
  const NearFieldBatch& scene = batch.eye.near_field;
  const int pixels = scene.pixels.row_count * scene.pixels.projection.width_px;
  WorkCounter& counter = work_counter(flat_look_up_name(scene.drawing));
  const WorkScope work(counter, pixels);
  run_on_cpu(active_table().look_up_flat_eyes, batch, pixels, active_table().lanes_float);
  finish(counter, Backend::cpu, scene);
}

void mark_object_tiles(Backend backend, const ObjectTileBatch& batch) {
  static WorkCounter counter("mark_object_tiles");
  const WorkScope work(counter, batch.count);
  if (backend == Backend::cuda) {
    return mark_object_tiles_cuda(batch);
  }
  run_on_cpu(active_table().mark_object_tiles, batch, batch.count, active_table().lanes_double, grid_grain);
}

void look_at_objects(Backend backend, const ObjectPixelBatch& batch) {
  static WorkCounter in_grids("look_at_objects");
  static WorkCounter in_slices("look_at_objects, slices");
  WorkCounter& counter = batch.pattern == PixelPattern::slices ? in_slices : in_grids;
  const WorkScope work(counter, batch.pattern == PixelPattern::slices
                                    ? static_cast<long>(batch.count) * batch.samples * batch.samples
                                    : batch.count);
  if (backend == Backend::cuda) {
    return look_at_objects_cuda(batch);
  }
  run_on_cpu(active_table().look_at_objects, batch, batch.count, active_table().lanes_double, grid_grain);
}

void mark_object_tiles(Backend backend, const FlatObjectTileBatch& batch) {
  static WorkCounter counter("mark_flat_object_tiles");
  const WorkScope work(counter, batch.tiles.count);
  if (backend == Backend::cuda) {
    return mark_flat_object_tiles_cuda(batch);
  }
  run_on_cpu(active_table().mark_flat_object_tiles, batch, batch.tiles.count, active_table().lanes_double, grid_grain);
}

void look_at_objects(Backend backend, const FlatObjectPixelBatch& batch) {
  static WorkCounter counter("look_at_flat_objects");
  const WorkScope work(counter, batch.pixels.count);
  if (backend == Backend::cuda) {
    return look_at_flat_objects_cuda(batch);
  }
  run_on_cpu(active_table().look_at_flat_objects, batch, batch.pixels.count, active_table().lanes_double, grid_grain);
}

void lay_objects(Backend backend, const LayObjectsBatch& batch) {
  const int pixels = batch.row_count * batch.projection.width_px;
  static WorkCounter counter("lay_objects");
  const WorkScope work(counter, pixels);
  if (backend == Backend::cuda) {
    return lay_objects_cuda(batch);
  }
  const LayObjects lay{batch};
  parallel_for(pixels, 64 * grain, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      lay(i);
    }
  });
}

}  // namespace ergodome
