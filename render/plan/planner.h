#pragma once

#include <string>

#include "content/show/show.h"
#include "render/plan/frame_needs.h"
#include "render/plan/frame_plan.h"

namespace ergodome {

//! Builds a FramePlan, one part of the renderer at a time.
class Planner {
 public:
  Planner(const Show& show, const FrameRequest& request);

  FramePlan plan();

 private:
  //! Returns a key with its location in the show file.
  [[nodiscard]] std::string why(const std::string& key) const;
  //! Returns the location where a key, or a number of that part of the show, is animated.
  [[nodiscard]] std::string why_animated(const std::string& key) const;
  //! Returns whether the sky turns and is therefore read again for each picture.
  [[nodiscard]] bool sky_turns() const;
  [[nodiscard]] std::string why_view() const;
  void pass(const std::string& name, WorkMoment moment, long runs, long elements, const std::string& reason,
            bool if_needed = false);
  void buffer(const std::string& name, WorkMoment moment, long bytes, const std::string& reason);
  //! Adds a pass over all pixels of all eyes, block by block.
  void pixel_pass(const std::string& name, const std::string& reason, bool if_needed = false);
  //! Returns whether the two eyes' skies are rendered alternately, which requires that, at least at
  //! times, nothing is near the hole.
  [[nodiscard]] bool makes_eyes_in_turn() const;
  [[nodiscard]] int count_strips() const;
  void plan_channels();
  [[nodiscard]] std::string variant(const char* kernel) const;
  //! Plans a grid that is traced at each new position.
  void plan_grid(const std::string& reason, bool if_needed);
  void plan_lens();
  void plan_direct(const std::string& reason);
  //! Plans rays that a heat map follows with one method, or to shells.
  void plan_followed();
  //! Plans the lenses that OmniChooser would choose.
  void plan_omni();
  void plan_shading();
  //! Plans the map in the form that its filter reads.
  void plan_map(const SkyShading& shading);
  //! Plans loading for all view modes, as a window can switch between them.
  void plan_star_loading();
  void plan_stars();
  //! Plans disk, shells and traced objects. Their tables are built for all view modes.
  void plan_near_field();
  //! Plans one ray for each pixel that may see disk, shells or objects, whatever the sky's lens.
  //! `shells`: with shells or without.
  void plan_near_rays(bool shells);
  void plan_disk_grid(const std::string& reason, bool if_needed);
  //! Returns whether the disk may be empty at times because its edges move.
  [[nodiscard]] bool disk_edges_move() const;
  [[nodiscard]] bool has_disk_always() const;
  void plan_streamed_disk(const std::string& reason);
  //! Plans a disk without shells: from baked layers or from grids, if these are worth building,
  //! except for pixels that show traced objects.
  void plan_disk_without_shells(DiskDrawing drawing, const std::string& reason, bool if_needed);
  //! Returns whether both eyes use one lens, that of the head, from different positions.
  [[nodiscard]] bool eyes_are_flat() const;
  //! Returns whether the baseline of such eyes is 0 at times, which makes both pictures equal to
  //! the head's.
  [[nodiscard]] bool eyes_are_together_at_times() const;
  //! Adds a pass over all pixels of both such eyes.
  void flat_pass(const std::string& name, const std::string& reason, bool if_needed);
  void plan_flat_near_field();
  void plan_flat_disk(bool if_needed);
  //! Plans one ray per tile, and several per pixel of tiles that may see objects.
  void plan_traced_objects(const std::string& objects);
  //! Plans reading meshes and opening OpenGL, for all view modes: a window can switch between them.
  void plan_objects();
  void plan_light();
  //! Plans overlays. Images are read for all view modes; what is drawn depends on the time.
  void plan_overlays();

  const Show show_;   //!< with each animated number at its maximum
  const Show least_;  //!< with each animated number at its minimum
  const FrameRequest& request_;
  FrameNeeds needs_;   //!< at any time
  FrameNeeds always_;  //!< at all times
  LensChannels channels_;
  FramePlan plan_;
  long pixels_;
  long gathers_ = 0;          //!< one per cube face
  long gathered_pixels_ = 0;  //!< pixels of all gathers
  int block_rows_;
  int blocks_;
  int strips_;     //!< parts of blocks in which the sky is made; 0: unknown
  int shown_ = 1;  //!< eyes whose pictures are drawn
};

}  // namespace ergodome
