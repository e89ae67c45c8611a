#pragma once

#include "render/disk/disk_pass.h"
#include "render/lens/picture_view.h"
#include "render/objects/traced_objects.h"
#include "render/shells/shell_pass.h"

namespace ergodome {

//! What stands near the hole in a picture; without any of it, nothing is traced.
struct NearField {
  const DiskPass* disk = nullptr;
  const ShellPass* shells = nullptr;
  TracedObjects* objects = nullptr;

  [[nodiscard]] bool empty() const { return disk == nullptr && shells == nullptr && objects == nullptr; }
};

//! Draws it, by exact rays, over rows of a picture in the backend's memory: four floats a pixel.
void draw_near_field(Backend backend, const NearField& near_field, const PictureView& view, const RowBlock& rows,
                     float* rgba);

}  // namespace ergodome
