#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "content/show/show.h"
#include "kernels/objects/draw_objects.h"
#include "kernels/objects/lay_objects.h"
#include "render/backend/buffer.h"
#include "render/lens/picture_view.h"
#include "render/passes/objects/lamp_guesses.h"
#include "render/passes/objects/placed_meshes.h"
#include "render/passes/objects/surface_store.h"
#include "render/picture/picture_rows.h"

namespace ergodome {

//! Draws a show's objects by exact rays around a hole of any spin: with all image orders, shadows,
//! frequency shift and light travel time.
//!
//! A tile of the picture that cannot see an object takes one ray. A pixel that can see one takes
//! four rays; sixteen if outlines, textures or shadows run through it or its neighbors; and up to
//! 144 next to the shadow's edge, where images are thin.
class TracedObjects {
 public:
  //! Loads the meshes; the show must have objects. Throws Error if a mesh or an image cannot be
  //! read.
  TracedObjects(const Show& show, Backend backend);

  //! Traces the objects in rows of a picture, at the time of the picture. The layer is valid until
  //! the next call.
  ObjectLayer draw(const PictureView& view, const RowBlock& rows) { return draw_rows(view, rows, {}); }

  //! Traces the objects in rows of the picture of an eye of the stereo model `flat`; `view` is that
  //! of the eye's head. The layer's `time` then holds minus the nearness of what is seen, 1 / (its
  //! distance from the eye in the head's flat space) [1/M].
  ObjectLayer draw(const PictureView& view, const RowBlock& rows, const FlatEyeSight& sight) {
    return draw_rows(view, rows, sight);
  }

  //! Returns an upper bound of r for all points of the objects at a show time [M].
  [[nodiscard]] double farthest_r(double time_s) const;

  //! Returns the objects' outlines at a show time.
  [[nodiscard]] std::vector<PlacedOutline> outlines(double time_s) const {
    return place_outlines(objects_, surfaces_.outlines(), time_s);
  }

  //! Returns the meshes of the objects at a show time, in host memory, to test what they hide.
  //! Omits large meshes that are only in GPU memory.
  [[nodiscard]] PlacedMeshes hiding(double time_s) const;

  //! Returns the objects that are partly invisible because they extend into the horizon.
  [[nodiscard]] const std::vector<ObjectInHorizon>& in_horizon() const { return surfaces_.in_horizon(); }

  //! Returns the number of triangles of all objects.
  [[nodiscard]] long triangle_count() const;

 private:
  ObjectLayer draw_rows(const PictureView& view, const RowBlock& rows, const std::optional<FlatEyeSight>& sight);
  //! Returns the objects of a picture in the form that kernels read.
  ObjectScene scene_for(const PictureView& view);
  //! Updates the starting values for the search of lamp rays (lamp_guesses()) in the backend's
  //! memory.
  void guess_lamp_rays(Spacetime spacetime, double time_s);

  Backend backend_;
  std::vector<ObjectSettings> objects_;
  LampSource lamp_;
  bool shifted_;
  SurfaceStore surfaces_;
  Buffer<SurfaceAppearance> appearances_;
  Buffer<PlacedMesh> placed_;
  std::optional<std::pair<Spacetime, double>> guessed_for_;  //!< spacetime and show time of `guesses_`
  Buffer<LampCorrections> guesses_;
  Buffer<double> cameras_;  //!< camera polynomials of an omnidirectional stereo eye
  Buffer<float> rgba_;
  Buffer<float> time_;
};

//! Creates the traced objects of a show; returns nullptr if it has none.
std::unique_ptr<TracedObjects> traced_objects_of(const Show& show, Backend backend);

}  // namespace ergodome
