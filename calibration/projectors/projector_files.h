#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "calibration/dome/dome_setup.h"
#include "calibration/formats/mpcdi/mpcdi.h"
#include "calibration/warps/warp_mesh.h"

namespace ergodome {

//! A projector with the contents of its files.
struct LoadedProjector {
  //! Nothing, a flat warp, or the surface that the raster lights. Maps are extended to the edge of
  //! the raster.
  std::variant<std::monostate, WarpMesh, SurfaceMesh> warp;
  WarpSource source = WarpSource::dome_picture;
  //! The lens of the view that a warp file (not MPCDI) states, or else the lens in the setup, or
  //! else that of the MPCDI region. The orientation is from the same source. The position is the
  //! setup's, unless the lens is the MPCDI region's.
  Lens lens;
  Vector3<double> position_m{};
  Orientation orientation;
  std::optional<MpcdiMask> blend;       //!< the setup's mask, or else the region's alphaMap
  std::optional<BlendMap> black_level;  //!< the setup's mask, or else the region's betaMap
  Vector3<double> black_level_lift{};   //!< the setup's lift; 1 if that is 0 and there is a betaMap
  std::vector<std::string> notes;       //!< remarks on the warp's file, for the user
};

//! Reads the warp and the masks of a projector. Throws Error, which names the file, for anything
//! that its reader refuses, for a missing region of a calibration, and if a calibration has several
//! regions but the setup names none.
LoadedProjector load_projector(const DomeSetup& setup, const ProjectorSetup& projector);

}  // namespace ergodome
