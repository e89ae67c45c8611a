#include "render/near_field/near_field.h"

#include "render/lens/direct_lens.h"

namespace ergodome {

void draw_near_field(Backend backend, const NearField& near_field, const EyeCamera& eye, const Projection& projection,
                     double tolerance_px, double time_s, int first_row, int row_count, float* rgba) {
  NearFieldBatch batch{pixel_batch(eye, projection, tolerance_px), DiskDrawing::none, {}, {}, rgba, {}};
  batch.pixels.first_row = first_row;
  batch.pixels.row_count = row_count;
  if (near_field.disk != nullptr && near_field.disk->is_visible()) {
    batch.disk = near_field.disk->look_at(time_s);
    batch.drawing = has_pattern(batch.disk) ? DiskDrawing::pattern : DiskDrawing::plain;
  }
  if (near_field.shells != nullptr) {
    batch.shells = near_field.shells->table();
  }
  if (near_field.objects != nullptr) {
    batch.objects = near_field.objects->look(eye, projection, tolerance_px, time_s, {first_row, row_count});
    if (batch.drawing == DiskDrawing::none && batch.shells.count == 0) {
      return lay_objects(backend, {batch.objects, batch.pixels.projection, first_row, row_count, rgba});
    }
  }
  draw_near_field(backend, batch);
}

}  // namespace ergodome
