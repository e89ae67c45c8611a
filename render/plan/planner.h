#pragma once

#include <string>

#include "content/show/show.h"
#include "render/plan/frame_needs.h"
#include "render/plan/frame_plan.h"

namespace ergodome {

//! Makes a FramePlan, a part of the renderer at a time.
class Planner {
 public:
  Planner(const Show& show, const FrameRequest& request);

  FramePlan plan();

 private:
  //! A key with where it stands.
  [[nodiscard]] std::string why(const std::string& key) const;
  //! Where the key, or a number of that part of the show, is animated.
  [[nodiscard]] std::string why_animated(const std::string& key) const;
  //! Whether the sky turns, and is read again for each picture.
  [[nodiscard]] bool sky_turns() const;
  [[nodiscard]] std::string why_view() const;
  void pass(const std::string& name, WorkMoment moment, long runs, long elements, const std::string& reason,
            bool if_needed = false);
  void buffer(const std::string& name, WorkMoment moment, long bytes, const std::string& reason);
  //! A pass over all pixels of all eyes, block by block.
  void pixel_pass(const std::string& name, const std::string& reason, bool if_needed = false);
  //! Whether the skies of two eyes are made in turn: where nothing stands near the hole, at times at least.
  [[nodiscard]] bool makes_eyes_in_turn() const;
  [[nodiscard]] int count_strips() const;
  void plan_channels();
  [[nodiscard]] std::string variant(const char* kernel) const;
  //! A grid that is traced at each new place.
  void plan_grid(const std::string& reason, bool if_needed);
  void plan_lens();
  void plan_direct(const std::string& reason);
  //! Rays that a heat map follows by a method, or to shells.
  void plan_followed();
  //! As OmniChooser chooses.
  void plan_omni();
  void plan_shading();
  //! The sky as its filter reads it.
  void plan_map(const SkyShading& shading);
  //! Whatever is shown: a window goes from view to view.
  void plan_star_loading();
  void plan_stars();
  //! Tables are made whatever is shown.
  void plan_near_field();
  //! A ray for each pixel that may see something, whatever the sky's lens is: with shells or without.
  void plan_near_rays(bool shells);
  void plan_disk_grid(const std::string& reason, bool if_needed);
  //! Whether there may be nothing of the disk between its edges at times.
  [[nodiscard]] bool disk_edges_move() const;
  [[nodiscard]] bool has_disk_always() const;
  void plan_streamed_disk(const std::string& reason);
  //! A disk without shells: from baked layers, or grids where they are worth their while, but for pixels that show traced objects.
  void plan_disk_without_shells(DiskDrawing drawing, const std::string& reason, bool if_needed);
  //! Whether both eyes see through one lens, the head's, from places of their own.
  [[nodiscard]] bool eyes_are_flat() const;
  //! And whether they are at one place at times: what they see is the head's then.
  [[nodiscard]] bool eyes_are_together_at_times() const;
  //! A pass over all pixels of both such eyes.
  void flat_pass(const std::string& name, const std::string& reason, bool if_needed);
  void plan_flat_near_field();
  void plan_flat_disk(bool if_needed);
  //! A ray for each tile, some for each pixel of those that may see objects.
  void plan_traced_objects(const std::string& objects);
  //! Meshes are read, and OpenGL is opened, whatever is shown: a window goes from view to view.
  void plan_objects();
  void plan_light();
  //! Images are read whatever is shown; what is drawn depends on the time.
  void plan_overlays();

  const Show show_;   //!< with each animated number at its greatest
  const Show least_;  //!< and at its least
  const FrameRequest& request_;
  FrameNeeds needs_;   //!< at some time
  FrameNeeds always_;  //!< at all times
  LensChannels channels_;
  FramePlan plan_;
  long pixels_;
  long gathers_ = 0;          //!< a face of a cube each
  long gathered_pixels_ = 0;  //!< of all of them
  int block_rows_;
  int blocks_;
  int strips_;     //!< parts of blocks that the sky is made in; 0: not known
  int shown_ = 1;  //!< eyes that see what is drawn
};

}  // namespace ergodome
