#include "calibration/projectors/projector_files.h"

#include <fmt/format.h>

#include <utility>

#include "calibration/formats/mpcdi/mpcdi_conversion.h"
#include "calibration/formats/mpcdi/mpcdi_reader.h"
#include "calibration/formats/warps/bourke_mesh.h"
#include "calibration/formats/warps/foreign_warp.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

//! Returns the region with an id, or the only one if `id` is empty.
const MpcdiRegion& region_of(const Mpcdi& mpcdi, const std::string& id, const std::string& file) {
  const MpcdiRegion* found = nullptr;
  std::string ids;
  int count = 0;
  for (const MpcdiBuffer& buffer : mpcdi.buffers) {
    for (const MpcdiRegion& region : buffer.regions) {
      found = id.empty() || region.id == id ? &region : found;
      ids += fmt::format("{}\"{}\"", count++ > 0 ? ", " : "", region.id.substr(0, 40));
    }
  }
  if (found == nullptr || (id.empty() && count > 1)) {
    throw Error(file, id.empty() ? "has several regions" : fmt::format("has no region \"{}\"", id.substr(0, 40)),
                "choose region from " + ids.substr(0, 1000));
  }
  return *found;
}

void load_region(const Mpcdi& mpcdi, const MpcdiRegion& region, const std::string& file, LoadedProjector& loaded) {
  if (region.geometry) {
    if (mpcdi.profile == MpcdiProfile::media_2d || mpcdi.profile == MpcdiProfile::simulation_3d) {
      loaded.warp = with_rim(warp_of(mpcdi, region, file));
      loaded.source = mpcdi.profile == MpcdiProfile::media_2d ? WarpSource::dome_picture : WarpSource::lens_picture;
    } else {
      loaded.warp = surface_of(mpcdi, region, file);
    }
  }
  if (std::holds_alternative<std::monostate>(loaded.lens) && region.orientation) {
    const ProjectorPose pose = pose_of(region);
    loaded.lens = lens_of(region);
    loaded.position_m = pose.position_m;
    loaded.orientation = pose.orientation;
  }
  loaded.blend = region.alpha;
  if (region.beta) {
    loaded.black_level = region.beta->map;
    loaded.black_level_lift = {1.0, 1.0, 1.0};
  }
}

void load_foreign_warp(const WarpFile& warp, const std::filesystem::path& path, LoadedProjector& loaded) {
  ForeignWarp foreign = read_foreign_warp(path, warp.format);
  loaded.warp = std::move(foreign.mesh);
  loaded.notes = std::move(foreign.notes);
  if (!foreign.view) {
    return;
  }
  loaded.source = WarpSource::lens_picture;
  loaded.lens = foreign.view->frustum;
  loaded.orientation = foreign.view->orientation;
  loaded.notes.push_back("the warp file gives the view " + words_of(*foreign.view));
}

void load_warp(const WarpFile& warp, const std::filesystem::path& path, double aspect, LoadedProjector& loaded) {
  loaded.source = warp.source;
  switch (warp.format) {
    case WarpFormat::bourke:
      loaded.warp = read_bourke_mesh(path, warp.x_to_one ? 1.0 : aspect);
      break;
    case WarpFormat::pfm:
      loaded.warp = with_rim(warp_from_map(read_float_map(path, warp.rows), warp.texture));
      break;
    case WarpFormat::mpcdi: {
      const Mpcdi mpcdi = read_mpcdi(path, warp.rows);
      load_region(mpcdi, region_of(mpcdi, warp.region, path.string()), path.string(), loaded);
      break;
    }
    case WarpFormat::domeprojection:
    case WarpFormat::obj:
    case WarpFormat::sciss:
    case WarpFormat::easyblend:
    case WarpFormat::simcad:
    case WarpFormat::skyskan:
      load_foreign_warp(warp, path, loaded);
      break;
  }
}

//! Returns the result of `read()` for a file that a projector names under `key`. Adds key and
//! projector to errors.
template <class Read>
auto read_for(const ProjectorSetup& projector, const char* key, const Read& read) {
  try {
    return read();
  } catch (const Error& error) {
    throw Error(error.location(), fmt::format("{} ({} of {})", error.problem(), key, location_of(projector)),
                error.remedy());
  }
}

//! Reads a mask of any size with the aspect ratio of the projector's raster.
BlendMap read_mask(const DomeSetup& setup, const ProjectorSetup& projector, const char* key, const std::string& file) {
  return read_for(projector, key, [&] {
    const std::filesystem::path path = setup.folder / file;
    BlendMap mask = read_blend_map(path);
    if (!has_shape_of(mask, projector.width_px, projector.height_px)) {
      throw Error(path.string(),
                  fmt::format("is a mask of {} x {} pixels, but the raster is {} x {}, with another aspect ratio",
                              mask.width, mask.height, projector.width_px, projector.height_px),
                  "save it in the raster's size, or smaller with the same aspect ratio");
    }
    return mask;
  });
}

}  // namespace

LoadedProjector load_projector(const DomeSetup& setup, const ProjectorSetup& projector) {
  LoadedProjector loaded;
  loaded.lens = projector.lens;
  loaded.position_m = projector.position_m;
  loaded.orientation = projector.orientation;
  if (projector.warp) {
    const double aspect = static_cast<double>(projector.width_px) / projector.height_px;
    read_for(projector, "warp",
             [&] { load_warp(*projector.warp, setup.folder / projector.warp->file, aspect, loaded); });
  }
  if (!projector.blend_mask.empty()) {
    loaded.blend =
        MpcdiMask{read_mask(setup, projector, "blend_mask", projector.blend_mask), projector.blend_mask_gamma};
  }
  if (!projector.black_level_mask.empty()) {
    loaded.black_level = read_mask(setup, projector, "black_level_mask", projector.black_level_mask);
  }
  const Vector3<double>& lift = projector.black_level_lift;
  if (lift.x > 0.0 || lift.y > 0.0 || lift.z > 0.0) {
    loaded.black_level_lift = lift;
  }
  return loaded;
}

}  // namespace ergodome
