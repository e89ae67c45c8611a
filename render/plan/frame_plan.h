#pragma once

#include <optional>
#include <string>
#include <vector>

#include "content/show/show.h"
#include "kernels/image/shade_pixels.h"
#include "kernels/launch/launch.h"
#include "render/lens/lens_source.h"

namespace ergodome {

//! How often a piece of work is done.
enum class WorkMoment {
  start,   //!< once, when the show is opened
  place,   //!< at each new place of the camera
  picture  //!< for each picture
};

//! A pass, or a kernel of one: its name is that of its counter (kernels/launch/work_counter.h).
struct PlannedPass {
  std::string name;
  WorkMoment moment;
  long runs;        //!< in all of that moment's pictures; 0: as many as it takes
  long elements;    //!< pixels, or nodes, or stars, in all; 0: as many as it takes
  bool if_needed;   //!< it may turn out that there is nothing to do
  std::string why;  //!< the keys of the show that call for it, with their lines
};

//! Memory that kernels reach, by the name of its counter.
struct PlannedBuffer {
  std::string name;
  WorkMoment moment;
  long bytes;  //!< 0: as many as it takes
  std::string why;
};

//! A number that the lens gives for each pixel.
struct PlannedChannel {
  std::string name;
  int floats;
  std::string why;
};

//! All that a picture of a show takes: nothing else is traced, stored, sent or launched.
struct FramePlan {
  int width_px = 0;
  int height_px = 0;
  int eyes = 1;      //!< pictures drawn through a lens
  std::string lens;  //!< where light paths come from: LensSource::name()
  std::vector<PlannedChannel> channels;
  std::vector<PlannedPass> passes;  //!< in the order in which they are first done
  std::vector<PlannedBuffer> buffers;
};

//! What is asked for beside the show.
struct FrameRequest {
  Backend backend = Backend::cpu;
  ViewMode mode = ViewMode::sky;
  LensChoice lens = LensChoice::automatic;
  std::optional<TraceMethod> method{};  //!< ViewChoice::method
  int size_px = 0;                      //!< width of one eye's image; 0: as the show says
  int map_width_px = 0;                 //!< of the sky's image
  bool streamed = false;                //!< the show's trajectory has been baked
  long overlay_bytes = 0;               //!< of the images that are laid over (OverlayPass::image_bytes)
  long mesh_bytes = 0;                  //!< of the objects (ObjectPass::mesh_bytes)
};

//! Plans the pictures that ShowRenderer::render makes; of a show whose numbers change, whatever one of them may take at its greatest
//! value, and what its least does without is there if needed. Effects and channels are decided by the same functions here and there
//! (render/plan/frame_needs.h); the order in which lenses are tried is LensChooser's own, followed here.
FramePlan plan_frame(const Show& show, const FrameRequest& request);

}  // namespace ergodome
