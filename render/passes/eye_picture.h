#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "content/show/show.h"
#include "kernels/sky/blackbody.h"
#include "render/eyes/eye_camera.h"
#include "render/lens/follow_lens.h"
#include "render/lens/lens_chooser.h"
#include "render/lens/omni_lens.h"
#include "render/passes/objects/polygons/omni_view.h"
#include "render/passes/sky/polygon_filter.h"
#include "render/passes/sky/sky_cube.h"
#include "render/passes/stars/drawing/star_trails.h"
#include "render/picture/picture.h"

// Describes an eye's picture to be rendered.

namespace ergodome {

class FlatShadow;
class Pass;

//! One of two eyes that share the camera of their head.
struct SharedCameraEye {
  std::shared_ptr<const FlatShadow> shadow;  //!< the head's shadow; the same object for both eyes
  Projection head_projection;
  double offset = 0.0;      //!< distance of the eye to the right of the head [M]
  std::vector<float> edge;  //!< FlatShadow::eye_edge of the offset
};

//! How an eye's picture is rendered: lens, filter of the sky's map, and what is drawn over it.
struct PictureSettings {
  ViewMode mode = ViewMode::sky;
  SkyFilter filter = SkyFilter::ewa;
  SkyShift shift = SkyShift::none;
  //! True: the map's light is multiplied by the magnification.
  bool brightening = false;
  const PolygonFilter* polygons = nullptr;  //!< required by SkyFilter::polygon
  //! Colors for SkyShift::blackbody_fit, in the backend's memory; the sky's texels must have been
  //! fitted by blackbodies.
  BlackbodyTable colours{};
  float exposure = 1.0F;
  //! The lens to use, instead of choosing one by `lens` and `accuracy`.
  const LensSource* given = nullptr;
  //! For heat maps of steps and error estimates: how their rays are followed (with any integrator,
  //! and to shells), instead of choosing a lens; see FollowLens.
  std::optional<FollowedRays> follow;
  LensChoice lens = LensChoice::automatic;
  LensAccuracy accuracy{};
  ShowMoment moment{};
  GridScheme scheme = GridScheme::conforming;
  //! ODS eye that sees stars, disk, shells and traced objects, instead of the picture's camera.
  std::shared_ptr<const OmniEye> omni;
  //! ODS view in which polygon objects are drawn, instead of the picture's camera.
  std::shared_ptr<const OmniView> omni_view;
  std::optional<SharedCameraEye> shared;  //!< set for one of two eyes that share the head's camera
  std::optional<Shutter> shutter;         //!< if given, stars leave trails
  double time_s = 0.0;                    //!< show time, for moving objects
  //! Receives the stars, which are then not drawn; see Picture::stars. Null: they are drawn.
  std::shared_ptr<StarLights> stars_apart{};
  //! Replaces the default value range of heat maps; must be above 0 if colors are logarithmic.
  std::optional<ViewRange> range{};
  //! The show with its animated numbers at this time; required by `passes`.
  const Show* show = nullptr;
  std::vector<Pass*> passes;  //!< passes that draw over the sky, in this order
};

//! Input for rendering an eye's picture.
struct EyePicture {
  EyeCamera eye;
  Projection projection;
  PictureSettings settings;
};

}  // namespace ergodome
