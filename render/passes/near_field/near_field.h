#pragma once

#include <optional>

#include "kernels/disk/disk_grid.h"
#include "render/lens/picture_view.h"
#include "render/passes/disk/disk_pass.h"
#include "render/passes/objects/traced_objects.h"
#include "render/passes/shells/shell_pass.h"

namespace ergodome {

//! What stands near the hole in a picture; without any of it, nothing is traced.
struct NearField {
  const DiskPass* disk = nullptr;
  const ShellPass* shells = nullptr;
  TracedObjects* objects = nullptr;
  //! Of the picture's place: the disk is read from it where no object is seen; not beside shells.
  std::optional<DiskGrid> disk_grid{};

  [[nodiscard]] bool empty() const { return disk == nullptr && shells == nullptr && objects == nullptr; }
};

//! Whether the disk is without shells, so that it may be read from a grid.
inline bool is_disk_without_shells(const NearField& near_field) {
  return near_field.disk != nullptr && near_field.disk->is_visible() && near_field.shells == nullptr;
}

//! Draws it, by exact rays or from the disk's grid, over rows of a picture in the backend's memory: four floats a pixel.
void draw_near_field(Backend backend, const NearField& near_field, const PictureView& view, const RowBlock& rows,
                     float* rgba);

}  // namespace ergodome
