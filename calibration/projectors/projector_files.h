#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "calibration/dome/dome_setup.h"
#include "calibration/formats/mpcdi/mpcdi.h"
#include "calibration/warps/warp_mesh.h"

namespace ergodome {

//! What the files of a projector say, beside its setup.
struct LoadedProjector {
  //! Nothing, a flat warp, or the surface that the raster meets. Maps are continued to the rim of the raster.
  std::variant<std::monostate, WarpMesh, SurfaceMesh> warp;
  WarpSource source = WarpSource::dome_picture;
  Lens lens;  //!< the setup's; where it has none, that of the MPCDI region, with position and orientation
  Vector3<double> position_m{};
  Orientation orientation;
  std::optional<MpcdiMask> blend;       //!< the setup's mask, or else the region's alphaMap
  std::optional<BlendMap> black_level;  //!< the setup's mask, or else the region's betaMap
  Vector3<double> black_level_lift{};   //!< the setup's; 1 where it is 0 and there is a betaMap
  std::vector<std::string> notes;       //!< remarks on the warp's file, for the user
};

//! Reads the warp and the masks of a projector of a setup. Throws Error, naming the file, for whatever its reader refuses, for a
//! region that a calibration does not have, and where it has several and the setup names none.
LoadedProjector load_projector(const DomeSetup& setup, const ProjectorSetup& projector);

}  // namespace ergodome
