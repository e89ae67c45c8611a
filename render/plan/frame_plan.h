#pragma once

#include <optional>
#include <string>
#include <vector>

#include "content/show/show.h"
#include "kernels/image/shade_pixels.h"
#include "kernels/launch/launch.h"
#include "kernels/spacetime/trace/trace_rays.h"
#include "render/lens/lens_source.h"

// Plans the work of a picture before it is rendered.

namespace ergodome {

//! How often a pass runs or a buffer is allocated.
enum class WorkMoment {
  start,     //!< once, when the show is opened
  position,  //!< at each new position of the camera
  picture    //!< for each picture
};

//! A pass, or a kernel that a pass runs. Its name is that of its work counter
//! (kernels/launch/work_counter.h).
struct PlannedPass {
  std::string name;
  WorkMoment moment;
  long runs;        //!< number of runs, for all eyes; 0: unknown
  long elements;    //!< total number of pixels, nodes or stars; 0: unknown
  bool if_needed;   //!< the pass may turn out to be unnecessary
  std::string why;  //!< the show's keys that require it, with their lines
};

//! Memory that kernels use, by the name of its work counter.
struct PlannedBuffer {
  std::string name;
  WorkMoment moment;
  long bytes;  //!< 0: unknown
  std::string why;
};

//! A value that the lens yields for each pixel.
struct PlannedChannel {
  std::string name;
  int floats;
  std::string why;
};

//! All work for a picture of a show. Rendering traces, stores, transfers and launches nothing else.
struct FramePlan {
  int width_px = 0;
  int height_px = 0;
  int eyes = 1;      //!< number of pictures that are drawn through a lens
  std::string lens;  //!< source of the lens: LensSource::name()
  std::vector<PlannedChannel> channels;
  std::vector<PlannedPass> passes;  //!< passes in the order of their first run
  std::vector<PlannedBuffer> buffers;
};

//! Settings and sizes that a plan depends on besides the show.
struct FrameRequest {
  Backend backend = Backend::cpu;
  ViewMode mode = ViewMode::sky;
  LensChoice lens = LensChoice::automatic;
  std::optional<TraceMethod> method{};  //!< integrator for heat maps of steps and errors
  int size_px = 0;                      //!< width of one eye's picture; 0: the show's
  int map_width_px = 0;                 //!< width of the sky map's image
  bool streamed = false;                //!< the show's trajectory has been baked
  long overlay_bytes = 0;               //!< memory of overlay images (OverlayPass::image_bytes())
  //! Memory of the objects' meshes (ObjectPass::mesh_bytes()).
  long mesh_bytes = 0;
};

}  // namespace ergodome
