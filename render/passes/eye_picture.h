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
#include "render/passes/objects/polygons/turning_view.h"
#include "render/passes/sky/polygon_filter.h"
#include "render/passes/sky/sky_cube.h"
#include "render/passes/stars/drawing/star_trails.h"
#include "render/picture/picture.h"

// An eye's picture to be made.

namespace ergodome {

class FlatShadow;
class Pass;

//! One of two eyes that share the camera of their head.
struct SharedCameraEye {
  std::shared_ptr<const FlatShadow> shadow;  //!< as the head sees it; the same object for both eyes
  Projection head_projection;
  double offset = 0.0;      //!< to the right of the head [M]
  std::vector<float> edge;  //!< FlatShadow::eye_edge of the offset
};

//! How the view through the lens is turned into a picture.
struct PictureSettings {
  ViewMode mode = ViewMode::sky;
  SkyFilter filter = SkyFilter::ewa;
  SkyShift shift = SkyShift::none;
  bool brightening = false;                 //!< multiply the map's light by the magnification
  const PolygonFilter* polygons = nullptr;  //!< required by SkyFilter::polygon
  //! For SkyShift::blackbody_fit, in the backend's memory; the sky must be fitted.
  BlackbodyTable colours{};
  float exposure = 1.0F;
  //! The lens to use, instead of choosing one by `lens` and `accuracy`.
  const LensSource* given = nullptr;
  std::optional<FollowedRays> follow;  //!< heat maps: the rays to show, instead of those to the sky
  LensChoice lens = LensChoice::automatic;
  LensAccuracy accuracy{};
  ShowMoment moment{};
  GridScheme scheme = GridScheme::conforming;
  //! Sees stars and near field instead of the picture's eye.
  std::shared_ptr<const OmniEye> turning;
  std::shared_ptr<const TurningView> turning_view;  //!< sees polygons instead of the picture's eye
  std::optional<SharedCameraEye> shared;            //!< if the picture's eye is the head's, for one of two eyes
  std::optional<Shutter> shutter;                   //!< if given, stars leave trails
  double time_s = 0.0;                              //!< show time, for moving objects
  //! Heat maps: replaces the default range; above 0 if colors are logarithmic.
  std::optional<ViewRange> range{};
  const Show* show = nullptr;  //!< with its numbers at this time; required by `passes`
  std::vector<Pass*> passes;   //!< drawn over the sky, in this order
};

//! Input for rendering an eye's picture.
struct EyePicture {
  EyeCamera eye;
  Projection projection;
  PictureSettings settings;
};

}  // namespace ergodome
