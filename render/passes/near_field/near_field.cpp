#include "render/passes/near_field/near_field.h"

#include "render/lens/direct_lens.h"

namespace ergodome {

void draw_near_field(Backend backend, const NearField& near_field, const PictureView& view, const RowBlock& rows,
                     float* rgba) {
  NearFieldBatch batch{
      pixel_batch(view.camera(), view.projection, view.tolerance_px), DiskDrawing::none, {}, {}, rgba, {}, false, {}};
  batch.pixels.first_row = rows.first;
  batch.pixels.row_count = rows.count;
  if (view.omni != nullptr) {
    batch.omni = view.omni->cameras->view(view.omni->side);
  }
  if (near_field.disk != nullptr && near_field.disk->is_visible()) {
    batch.disk = near_field.disk->look_at(view.time_s, view.camera().clock_lead);
    batch.drawing = has_pattern(batch.disk) ? DiskDrawing::pattern : DiskDrawing::plain;
  }
  if (near_field.shells != nullptr) {
    batch.shells = near_field.shells->table();
  }
  if (near_field.objects != nullptr) {
    batch.objects = near_field.objects->draw(view, rows);
    if (batch.drawing == DiskDrawing::none && batch.shells.count == 0) {
      return launch(backend, LayObjectsBatch{batch.objects, batch.pixels.projection, rows.first, rows.count, rgba});
    }
  }
  if (near_field.disk_grid) {
    const EyeCamera& eye = view.camera();
    launch(DiskLookUpBatch{
        batch, *near_field.disk_grid,
        converted_aberration<float>(aberration_to_rain(eye.spacetime, eye.r, eye.theta, eye.motion, eye.velocity))});
    if (near_field.objects == nullptr) {
      return;
    }
    batch.objects_alone = true;
  }
  launch(backend, batch);
}

}  // namespace ergodome
