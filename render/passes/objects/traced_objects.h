#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "content/show/show.h"
#include "kernels/objects/lay_objects.h"
#include "render/backend/buffer.h"
#include "render/lens/picture_view.h"
#include "render/passes/objects/lamp_guesses.h"
#include "render/passes/objects/placed_meshes.h"
#include "render/passes/objects/surface_store.h"

namespace ergodome {

//! A block of rows of a picture.
struct RowBlock {
  int first;
  int count;
};

//! A show's objects as exact rays see them, about a hole of any spin: all image orders, shadows, frequency shift, light travel time.
//!
//! Tiles of the picture that cannot see an object cost a ray; pixels that can cost four, and sixteen where outlines, textures or shadows run through them or
//! their neighbours; next to the shadow's edge, where images are thin, up to 144.
class TracedObjects {
 public:
  //! Loads the meshes; the show must have objects. Throws Error where a mesh or an image cannot be read.
  TracedObjects(const Show& show, Backend backend);

  //! Looks at the objects in rows of a picture, where they are at its time. The layer stays until the next call.
  ObjectLayer look(const PictureView& view, const RowBlock& rows) { return look_at_rows(view, rows, {}); }

  //! The same for an eye of the stereo model `flat`, beside the head that the view is of; the layer's time is minus the nearness.
  ObjectLayer look(const PictureView& view, const RowBlock& rows, const FlatEyeSight& sight) {
    return look_at_rows(view, rows, sight);
  }

  //! The radius that no object reaches beyond at a time of the show [M].
  [[nodiscard]] double farthest_r(double time_s) const;

  //! The objects' outlines, where they are at a time of the show.
  [[nodiscard]] std::vector<PlacedOutline> outlines(double time_s) const {
    return place_outlines(objects_, surfaces_.outlines(), time_s);
  }

  //! The objects, where they are at a time of the show, as they hide what is behind them: in host memory, without those whose meshes are not there.
  [[nodiscard]] PlacedMeshes hiding(double time_s) const;

  //! Objects of which some is not to be seen, as it lies within the horizon.
  [[nodiscard]] const std::vector<ObjectInHorizon>& in_horizon() const { return surfaces_.in_horizon(); }

  //! Triangles of all objects.
  [[nodiscard]] long triangle_count() const;

 private:
  ObjectLayer look_at_rows(const PictureView& view, const RowBlock& rows, const std::optional<FlatEyeSight>& sight);
  //! The objects of a picture as kernels have them.
  ObjectScene scene_for(const PictureView& view);
  //! Has the lamp's guesses for a picture where kernels reach them.
  void guess_lamp_rays(double spin, double time_s);

  Backend backend_;
  std::vector<ObjectSettings> objects_;
  LampPlace lamp_;
  bool shifted_;
  SurfaceStore surfaces_;
  Buffer<SurfaceLook> looks_;
  Buffer<PlacedMesh> placed_;
  std::optional<std::pair<double, double>> guessed_for_;  //!< spin and time
  Buffer<LampCorrections> guesses_;
  Buffer<double> cameras_;  //!< of an eye that turns
  Buffer<float> rgba_;
  Buffer<float> time_;
};

//! Those of a show whose objects are traced; else none.
std::unique_ptr<TracedObjects> traced_objects_of(const Show& show, Backend backend);

}  // namespace ergodome
