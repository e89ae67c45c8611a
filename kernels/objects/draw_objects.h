#pragma once

#include <cstdint>

#include "kernels/launch/kernel.h"
#include "kernels/objects/lamp_source.h"
#include "kernels/objects/mesh_rays.h"
#include "kernels/objects/surface.h"
#include "kernels/projection/projection.h"
#include "kernels/spacetime/shadow/flat_horizon.h"
#include "kernels/spacetime/trace/omni_camera.h"

// Batches that draw objects: tiles are marked first, then their pixels are drawn.
namespace ergodome {

//! The objects of a scene, and the eye that sees them.
struct ObjectScene {
  CameraStation camera;
  Projection projection;
  //! Rows: the observer's frame (e_r, e_θ, e_φ); columns: the view's x (right), y (up), z (back).
  double frame_from_view[3][3];
  MeshScene scene;
  const SurfaceAppearance* appearances;  //!< one per mesh
  LampSource lamp;                       //!< strength 0: no lamp
  //! First guesses, one per mesh: corrections of the lamp's rays to the mesh's middle.
  const LampCorrections* guesses;
  MeshLimits limits;
  bool shifted;   //!< light is multiplied by g⁴
  bool retarded;  //!< at least one mesh is `retarded`: seen where it was when its light left
  //! Camera of an omnidirectional eye, used if it has coefficients. It then replaces `camera`,
  //! which is the head's and only supplies spin and azimuth. Directions are then in the view's
  //! axes.
  OmniCameraOf<double> omni;
};

//! Kinds of objects that the pixels of a square tile may see.
enum class TileMark : std::uint8_t {
  nothing,
  objects,
  stretched,  //!< objects that are far narrower across the shadow's edge than along it
  fine,       //!< an object that is not much larger than a pixel's footprint at the object
  thin,       //!< a stretched object that is not much wider than a pixel across the shadow's edge
  edge        //!< the shadow's edge is in the tile or next to it, so anything may be seen
};

//! Marks the tiles of an image with what their pixels may see.
struct ObjectTileBatch {
  ObjectScene objects;
  const std::int32_t* tiles;  //!< x and y of each tile's first pixel
  int count;
  int side_px;
  //! Next to the shadow, the rays of adjacent pixels move in planes through the hole that are
  //! rotated by up to this angle relative to each other [rad].
  double turn_per_px;
  TileMark* marks;  //!< one per tile
};

//! Values of ObjectPixelBatch::content that are not the index of a mesh.
inline constexpr std::int32_t pixel_of_nothing = -1;
inline constexpr std::int32_t pixel_of_several = -2;

//! Positions of the rays in a pixel.
enum class PixelPattern : std::uint8_t {
  grid,
  slices  //!< thin strips along the shadow's edge, thinner nearer to it
};

//! Draws objects in the given pixels.
struct ObjectPixelBatch {
  ObjectScene objects;
  const std::int32_t* pixels;  //!< x and y of each pixel
  int count;
  PixelPattern pattern;
  //! Number of samples along each side of a pixel, or the square root of the number of slices;
  //! even.
  int samples;
  //! Four per pixel: linear light times the fraction of the pixel that objects cover, and that
  //! fraction.
  float* rgba;
  float* time;  //!< one per pixel: mean Mino time from the objects to the camera; 0 without any
  //! One per pixel: the index of the mesh that fills it with little contrast, or pixel_of_nothing,
  //! or pixel_of_several. With slices, pixel_of_several means that objects may be thinner than the
  //! slices resolve; otherwise the content is the first mesh met.
  std::int32_t* content;
};

//! Calls action(functor) with Functor<T, parts> for a batch. `parts`: the quantities that rays
//! carry; they include the delay only if a mesh is retarded.
template <template <class, NearParts> class Functor, class T, class Batch, class Action>
inline void dispatch_objects(const Batch& batch, const Action& action) {
  if (batch.objects.retarded) {
    action(Functor<T, NearParts::azimuth_and_delay>{batch});
  } else {
    action(Functor<T, NearParts::azimuth>{batch});
  }
}

//! An eye of the stereo model `flat`. It sees what the head's rays meet, at its position in the
//! head's flat space (kernels/eyes/flat/eye_path.h).
struct FlatEyeSight {
  Vector3<double> eye;  //!< position of the eye relative to the head, in the observer's frame [M]; not 0
  double max_w;         //!< nothing that is nearer to the eye than 1 / max_w is drawn [1/M]
  //! Maximum nearness of the region around the hole, in which rays of adjacent pixels separate: all
  //! light from there comes from farther than 1 / max_hole_w [1/M].
  double max_hole_w;
  double pixel;  //!< angle that a pixel of the picture subtends [rad]
  //! Maximum error, in pixels, of the positions that one ray predicts for the rays beside it.
  double tolerance_px;
  FlatHorizon horizon;
};

//! Number of parts into which lines of sight of slices are cut, each with a head's ray of its own,
//! and the maximum sweep of these lines [px] for which slices are used. The sweep is the angle
//! between a line's ends as the head sees them.
inline constexpr double parts_of_slices = 2.0;
inline constexpr double max_way_of_slices = 4.0;

//! The part of an eye's lines of sight on which objects may be.
struct FlatReach {
  float min_w;  //!< minimum nearness to the eye at which objects may be [1/M]
  float max_w;
  float width;  //!< maximum width of a pixel at these objects, divided by their r
};

//! Tiles of the image of an eye of the stereo model `flat`.
struct FlatObjectTileBatch {
  ObjectTileBatch tiles;
  FlatEyeSight sight;
  //! Maximum length of a part of an eye's line of sight, as the head sees it [rad]. One ray of the
  //! head represents each part.
  double part;
  const FlatReach* along;  //!< one per tile: part of the line of sight to search
  FlatReach* reach;        //!< one per tile: where objects may be, if any
};

//! Pixels of the image of an eye of the stereo model `flat`.
struct FlatObjectPixelBatch {
  ObjectPixelBatch pixels;  //!< its member `time` holds minus the mean nearness
  FlatEyeSight sight;
  const FlatReach* reach;  //!< one per pixel: part of the line of sight on which objects may be
};

//! Calls action(functor) for a batch of an eye of the stereo model `flat`. Rays carry the delay
//! only if a mesh is `retarded`.
template <template <class, NearParts> class Functor, class T, class Batch, class Action>
inline void dispatch_flat_objects(bool retarded, const Batch& batch, const Action& action) {
  if (retarded) {
    action(Functor<T, NearParts::azimuth_delay_and_distance>{batch});
  } else {
    action(Functor<T, NearParts::azimuth_and_distance>{batch});
  }
}

template <>
struct Kernel<ObjectTileBatch> : KernelDefaults {
  using Real = double;
  static constexpr int grain = grid_grain;
  static const char* name(const ObjectTileBatch& /*batch*/) { return "mark_object_tiles"; }
  static int elements(const ObjectTileBatch& batch) { return batch.count; }
};

template <>
struct Kernel<ObjectPixelBatch> : KernelDefaults {
  using Real = double;
  static constexpr int grain = grid_grain;
  static const char* name(const ObjectPixelBatch& batch) {
    return batch.pattern == PixelPattern::slices ? "look_at_objects, slices" : "look_at_objects";
  }
  static int elements(const ObjectPixelBatch& batch) { return batch.count; }
  static long work(const ObjectPixelBatch& batch) {
    return batch.pattern == PixelPattern::slices ? static_cast<long>(batch.count) * batch.samples * batch.samples
                                                 : batch.count;
  }
};

template <>
struct Kernel<FlatObjectTileBatch> : KernelDefaults {
  using Real = double;
  static constexpr int grain = grid_grain;
  static const char* name(const FlatObjectTileBatch& /*batch*/) { return "mark_flat_object_tiles"; }
  static int elements(const FlatObjectTileBatch& batch) { return batch.tiles.count; }
};

template <>
struct Kernel<FlatObjectPixelBatch> : KernelDefaults {
  using Real = double;
  static constexpr int grain = grid_grain;
  static const char* name(const FlatObjectPixelBatch& /*batch*/) { return "look_at_flat_objects"; }
  static int elements(const FlatObjectPixelBatch& batch) { return batch.pixels.count; }
};

}  // namespace ergodome
