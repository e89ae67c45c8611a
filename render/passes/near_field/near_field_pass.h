#pragma once

#include <memory>
#include <string>
#include <vector>

#include "render/backend/buffer.h"
#include "render/passes/disk/disk_grids.h"
#include "render/passes/disk/streamed_disk.h"
#include "render/passes/near_field/flat_near_field.h"
#include "render/passes/near_field/near_field.h"
#include "render/passes/near_field/near_field_kind.h"
#include "render/passes/pass.h"

namespace ergodome {

//! Draws disk, shells and traced objects of a show in one pass, because a ray may meet them in any
//! order.
class NearFieldPass : public Pass {
 public:
  //! Loads the objects' meshes, and the shells' textures unless the pass of the previous show has
  //! the same ones. Shares the disk and its grids with that pass. Throws Error if something cannot
  //! be read.
  explicit NearFieldPass(const PassInput& input);

  [[nodiscard]] const PassKind& kind() const override { return near_field_kind; }
  std::unique_ptr<PassDrawing> prepare(const EyePicture& picture) override;
  void apply(const Show& show, const NumberChange& change) override;
  [[nodiscard]] bool serves(const Show& now, const Show& next) const override;
  [[nodiscard]] std::vector<std::string> notes(const Show& show) const override;

  //! Returns the traced objects, or nullptr for a show without them.
  [[nodiscard]] const TracedObjects* objects() const { return objects_.get(); }

 private:
  class Drawing;
  class SharedCameraDrawing;

  //! Grids of the disk, which stay valid when the show changes.
  struct Grids {
    DiskGrids eyes;
    DiskGrids heads;  //!< grids for heads of the stereo model `flat`, whose eyes share a lens
  };

  //! The parts that two eyes have in common if they share their head's camera.
  struct SharedCamera {
    SharedCamera(NearFieldPass& pass, const EyePicture& picture);

    std::shared_ptr<const FlatShadow> shadow;
    NearField parts;
    FlatNearField drawing;
  };

  //! Returns the parts that a picture shows, and sets how its shells look: as in the show, or with
  //! thin white lines only if the picture is a heat map.
  [[nodiscard]] NearField parts_for(const EyePicture& picture) const;
  //! Returns the parts that a picture shows, for an eye that shares its head's camera. Reads the
  //! disk from a grid at the head, if that is worth building.
  NearField parts_for_shared_camera(const EyePicture& picture);

  Backend backend_;
  std::shared_ptr<DiskPass> disk_;          //!< set if the show has a disk
  std::shared_ptr<ShellPass> shells_;       //!< set if the show has shells
  std::unique_ptr<TracedObjects> objects_;  //!< set if the show has traced objects
  std::shared_ptr<Grids> grids_;
  StreamedDisk streamed_disk_;
  Buffer<float> flat_rows_;  //!< picture rows in GPU memory, for eyes that share a camera
  //! Near field of the last eye that shared its head's camera, kept for the head's other eye.
  std::unique_ptr<SharedCamera> shared_camera_;
};

}  // namespace ergodome
