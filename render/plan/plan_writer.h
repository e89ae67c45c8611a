#pragma once

#include <span>
#include <string>

#include "content/show/show.h"
#include "kernels/projection/projection.h"
#include "render/plan/frame_plan.h"
#include "render/plan/pass_kind.h"

namespace ergodome {

//! Collects the frame plan to which all passes add their work, one after the other. Also provides
//! what passes need to know about the show's pictures.
class PlanWriter {
 public:
  //! `kinds`: all kinds of passes, in drawing order.
  PlanWriter(const Show& show, const FrameRequest& request, std::span<const PassKind> kinds);

  //! Returns the finished plan.
  FramePlan finish();

  //! maximum() returns the show with every animated number at its maximum, minimum() at its
  //! minimum.
  [[nodiscard]] const Show& maximum() const { return maximum_; }
  [[nodiscard]] const Show& minimum() const { return minimum_; }
  [[nodiscard]] const FrameRequest& request() const { return request_; }
  //! Returns whether kernels run on the CPU.
  [[nodiscard]] bool on_cpu() const { return request_.backend == Backend::cpu; }

  //! Returns the projection of one eye's picture.
  [[nodiscard]] const Projection& projection() const { return projection_; }
  [[nodiscard]] int width_px() const { return plan_.width_px; }
  [[nodiscard]] int height_px() const { return plan_.height_px; }
  //! Returns the number of pixels of a picture.
  [[nodiscard]] long pixels() const { return static_cast<long>(width_px()) * height_px(); }
  //! eyes() returns the number of pictures drawn through a lens, shown() the number of pictures
  //! that are shown.
  [[nodiscard]] int eyes() const { return plan_.eyes; }
  [[nodiscard]] int shown() const { return shown_; }
  [[nodiscard]] int block_rows() const { return block_rows_; }
  [[nodiscard]] int blocks() const;

  //! Returns whether the baseline is 0 at times. Then both pictures are equal to the head's.
  [[nodiscard]] bool eyes_are_together_at_times() const;
  //! Returns whether the skies of the two eyes are rendered alternately, at least at times. This
  //! requires the CPU, a stereo model in which each eye has its own camera, and a time at which no
  //! pass with PassKind::serves_one_picture draws.
  [[nodiscard]] bool makes_eyes_in_turn() const;
  //! Returns whether an animation rotates the sky, which is then resampled for each picture.
  [[nodiscard]] bool sky_turns() const;

  //! Returns a key of the show as the reason for work, with its line in the show file (or "by
  //! default", or --set), and with the lines of the animations of the key or of numbers below it.
  [[nodiscard]] std::string why(const std::string& key) const;
  //! Returns the reason why the lens is needed: the key sky.map for the view of the sky, otherwise
  //! the requested view mode.
  [[nodiscard]] std::string why_view() const;

  //! Sets the name of the lens's source.
  void set_lens(const char* name) { plan_.lens = name; }
  void channel(const char* name, int floats, const std::string& reason);
  void pass(const std::string& name, WorkMoment moment, long runs, long elements, const std::string& reason,
            bool if_needed = false);
  void buffer(const std::string& name, WorkMoment moment, long bytes, const std::string& reason);
  //! Adds a pass that is run over all pixels of the pictures drawn through a lens (eyes()), block
  //! by block.
  void pixel_pass(const std::string& name, const std::string& reason, bool if_needed = false);
  //! Adds a pass that is run once over each finished picture that is shown (shown()).
  void picture_pass(const std::string& name, const std::string& reason, bool if_needed = false);

 private:
  [[nodiscard]] std::string why_animated(const std::string& key) const;
  //! Returns the number of blocks, or of parts of blocks if eyes alternate, in which the sky of one
  //! picture is rendered; 0: unknown.
  [[nodiscard]] int strips() const;
  //! Returns whether a picture of a show needs a pass with PassKind::serves_one_picture.
  [[nodiscard]] bool needs_one_picture(const Show& show) const;

  const Show maximum_;
  const Show minimum_;
  const FrameRequest& request_;
  std::span<const PassKind> kinds_;
  const Projection projection_;
  FramePlan plan_;
  int block_rows_;
  int shown_;
};

}  // namespace ergodome
