#pragma once

#include <optional>

#include "kernels/near_field/look_up_disk.h"
#include "render/lens/picture_view.h"
#include "render/passes/disk/disk_pass.h"
#include "render/passes/objects/traced_objects.h"
#include "render/passes/shells/shell_pass.h"

namespace ergodome {

//! The things near the hole that pictures show; a pointer is nullptr if the show lacks that thing.
struct NearField {
  const DiskPass* disk = nullptr;
  const ShellPass* shells = nullptr;
  TracedObjects* objects = nullptr;
  //! Disk grid at the camera's position. The disk is read from it in pixels without objects. Not
  //! set if there are shells.
  std::optional<DiskGrid> disk_grid{};

  [[nodiscard]] bool empty() const { return disk == nullptr && shells == nullptr && objects == nullptr; }
};

//! Returns whether a visible disk is present without shells, so that it may be read from a grid.
inline bool is_disk_without_shells(const NearField& near_field) {
  return near_field.disk != nullptr && near_field.disk->is_visible() && near_field.shells == nullptr;
}

//! Draws the near field, by exact rays or from the disk grid, over rows of a picture in the
//! backend's memory: four floats per pixel.
void draw_near_field(Backend backend, const NearField& near_field, const PictureView& view, const RowBlock& rows,
                     float* rgba);

}  // namespace ergodome
