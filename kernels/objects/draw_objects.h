#pragma once

#include <cstdint>

#include "kernels/eyes/flat/flat_horizon.h"
#include "kernels/eyes/omni/omni_camera.h"
#include "kernels/objects/lamp_place.h"
#include "kernels/objects/mesh_rays.h"
#include "kernels/objects/surface.h"
#include "kernels/projection/projection.h"

namespace ergodome {

//! Objects as an eye sees them.
struct ObjectScene {
  CameraStation camera;
  Projection projection;
  double
      frame_from_view[3]
                     [3];  //!< columns: the view's x (right), y (up), z (back) in the observer's frame (e_r, e_θ, e_φ)
  MeshScene scene;
  const SurfaceLook* looks;        //!< one a mesh
  LampPlace lamp;                  //!< strength 0: none
  const LampCorrections* guesses;  //!< one a mesh: what spin adds to the lamp's rays to its middle
  MeshLimits limits;
  bool shifted;   //!< light goes with g⁴
  bool retarded;  //!< some mesh is
  //! What sees them in place of the camera, where it has coefficients: that is the head's then, for spin and azimuth, and the frame the view's.
  OmniCameraOf<double> turning;
};

//! What pixels of a square tile may see of the objects.
enum class TileMark : std::uint8_t {
  nothing,
  objects,
  stretched,  //!< of objects that are far narrower across the shadow's edge than along it
  fine,       //!< of an object that is not much larger than a pixel there
  thin,       //!< of one that is stretched, and not much wider than a pixel across
  edge        //!< the shadow's edge is in it or beside it: of anything
};

//! Tiles of an image to be marked.
struct ObjectTileBatch {
  ObjectScene objects;
  const std::int32_t* tiles;  //!< two numbers each: their first pixel, x and y
  int count;
  int side_px;
  double turn_per_px;  //!< by so much the planes of neighbours' rays are turned beside the shadow [rad]
  TileMark* marks;     //!< one a tile
};

//! What a pixel is full of, if not the number of a mesh.
inline constexpr std::int32_t pixel_of_nothing = -1;
inline constexpr std::int32_t pixel_of_several = -2;

//! Where in a pixel its rays are.
enum class PixelPattern : std::uint8_t {
  grid,
  slices  //!< along the shadow's edge, the thinner the nearer to it
};

//! Pixels to be looked at.
struct ObjectPixelBatch {
  ObjectScene objects;
  const std::int32_t* pixels;  //!< two numbers each: x and y
  int count;
  PixelPattern pattern;
  int samples;  //!< along each side of a pixel, or the root of how many slices it has: even
  float* rgba;  //!< four a pixel: linear light times the part of the pixel that objects cover, and that part
  float* time;  //!< one a pixel: mean Mino time from the objects to the camera, where there are any
  //! One a pixel: the mesh that all of it shows with little contrast, or one of the above. Of slices `several` is what may be thinner than they tell.
  std::int32_t* content;
};

//! Calls action(functor) with Functor<T, what rays carry> for a batch.
template <template <class, NearParts> class Functor, class T, class Batch, class Action>
inline void dispatch_objects(const Batch& batch, const Action& action) {
  if (batch.objects.retarded) {
    action(Functor<T, NearParts::azimuth_and_delay>{batch});
  } else {
    action(Functor<T, NearParts::azimuth>{batch});
  }
}

//! An eye of the stereo model `flat`, which sees what the head's rays meet where they are in the head's flat space (kernels/mesh/eye_path.h).
struct FlatEyeSight {
  Vector3<double> eye;  //!< beside the head, in the observer's frame [M]; not 0
  double most_w;        //!< nothing is nearer to the eye than 1 / most_w, or is not drawn there [1/M]
  double
      most_hole_w;  //!< light does not come from the hole's neighbourhood, where neighbouring rays part, before 1 / this
  double pixel;     //!< of the picture, as an angle [rad]
  double tolerance_px;  //!< what a ray says of its neighbours may be off by so much
  FlatHorizon horizon;
};

//! Slices' lines of sight have rays of the head's own; they are cut into so many parts, and there are none where the eye's way is longer than this many pixels.
inline constexpr double parts_of_slices = 2.0;
inline constexpr double most_way_of_slices = 4.0;

//! The part of an eye's lines of sight on which objects may be.
struct FlatReach {
  float least_w;  //!< nearness [1/M]
  float most_w;
  float width;  //!< a pixel is so wide there, over r
};

//! Tiles of such an eye's image.
struct FlatObjectTileBatch {
  ObjectTileBatch tiles;
  FlatEyeSight sight;
  double part;             //!< of a line that a ray stands for, as the head sees it [rad]
  const FlatReach* along;  //!< one a tile: where to look
  FlatReach* reach;        //!< one a tile: where something is, if anything
};

//! Pixels of it.
struct FlatObjectPixelBatch {
  ObjectPixelBatch pixels;  //!< `time`: minus the mean nearness
  FlatEyeSight sight;
  const FlatReach* reach;  //!< one a pixel
};

//! Calls action(functor) for a batch of such an eye.
template <template <class, NearParts> class Functor, class T, class Batch, class Action>
inline void dispatch_flat_objects(bool retarded, const Batch& batch, const Action& action) {
  if (retarded) {
    action(Functor<T, NearParts::azimuth_delay_and_distance>{batch});
  } else {
    action(Functor<T, NearParts::azimuth_and_distance>{batch});
  }
}

}  // namespace ergodome
