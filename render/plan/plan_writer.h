#pragma once

#include <span>
#include <string>

#include "content/show/show.h"
#include "kernels/projection/projection.h"
#include "render/plan/frame_plan.h"
#include "render/plan/pass_kind.h"

namespace ergodome {

//! A frame plan that passes write, one after the other, and what they need to know about the show's
//! pictures.
class PlanWriter {
 public:
  //! `kinds`: all passes, in their order.
  PlanWriter(const Show& show, const FrameRequest& request, std::span<const PassKind> kinds);

  //! Returns the finished plan.
  FramePlan finish();

  //! The show with each animated number at its maximum or at its minimum.
  [[nodiscard]] const Show& most() const { return most_; }
  [[nodiscard]] const Show& least() const { return least_; }
  [[nodiscard]] const FrameRequest& request() const { return request_; }
  //! Returns whether kernels run on the CPU.
  [[nodiscard]] bool on_cpu() const { return request_.backend == Backend::cpu; }

  //! Returns the projection of one eye's picture.
  [[nodiscard]] const Projection& projection() const { return projection_; }
  [[nodiscard]] int width_px() const { return plan_.width_px; }
  [[nodiscard]] int height_px() const { return plan_.height_px; }
  //! Returns the pixels of a picture.
  [[nodiscard]] long pixels() const { return static_cast<long>(width_px()) * height_px(); }
  //! Returns the pictures drawn through a lens, and those that are shown.
  [[nodiscard]] int eyes() const { return plan_.eyes; }
  [[nodiscard]] int shown() const { return shown_; }
  [[nodiscard]] int block_rows() const { return block_rows_; }
  [[nodiscard]] int blocks() const;

  //! Returns whether the baseline is 0 at times, which makes both pictures equal to the head's.
  [[nodiscard]] bool eyes_are_together_at_times() const;
  //! Returns whether the two eyes' skies are rendered alternately, which requires that no pass
  //! serves one picture only, at least at times.
  [[nodiscard]] bool makes_eyes_in_turn() const;
  //! Returns whether the sky turns and is therefore read again for each picture.
  [[nodiscard]] bool sky_turns() const;

  //! Returns a key with its location in the show file and the location where it, or a number of
  //! that part of the show, is animated.
  [[nodiscard]] std::string why(const std::string& key) const;
  //! Returns the reason for what only the requested view mode needs.
  [[nodiscard]] std::string why_view() const;

  //! Names the source of the lens.
  void set_lens(const char* name) { plan_.lens = name; }
  void channel(const char* name, int floats, const std::string& reason);
  void pass(const std::string& name, WorkMoment moment, long runs, long elements, const std::string& reason,
            bool if_needed = false);
  void buffer(const std::string& name, WorkMoment moment, long bytes, const std::string& reason);
  //! Adds a pass over all pixels of all eyes, block by block.
  void pixel_pass(const std::string& name, const std::string& reason, bool if_needed = false);
  //! Adds a pass over the finished pictures that are shown.
  void picture_pass(const std::string& name, const std::string& reason, bool if_needed = false);

 private:
  [[nodiscard]] std::string why_animated(const std::string& key) const;
  //! Returns the parts of blocks in which the sky is made; 0: unknown.
  [[nodiscard]] int strips() const;
  //! Returns whether a picture of a show needs a pass that serves one picture only.
  [[nodiscard]] bool needs_one_picture(const Show& show) const;

  const Show most_;
  const Show least_;
  const FrameRequest& request_;
  std::span<const PassKind> kinds_;
  const Projection projection_;
  FramePlan plan_;
  int block_rows_;
  int shown_;
};

}  // namespace ergodome
