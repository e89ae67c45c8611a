#pragma once

#include "kernels/eyes/flat/draw_flat_eyes.h"
#include "render/lens/flat/flat_shadow.h"
#include "render/passes/near_field/near_field.h"

namespace ergodome {

//! Draws the disk, shells and objects for eyes of the stereo model `flat`, which share one lens: a
//! thing at the affine distance d in the head's direction n is placed at d n
//! (kernels/eyes/flat/eye_line.h).
class FlatNearField {
 public:
  //! `head` and `shadow`: the head to which the eyes belong, and its shadow. If
  //! NearField::disk_grid is set, pixels without objects read the disk from it; that grid must be
  //! the head's and include nearness. `rows` is a buffer reused between pictures, for rows drawn on
  //! a GPU.
  FlatNearField(Backend backend, const NearField& near_field, const EyeCamera& head, const FlatShadow& shadow,
                Buffer<float>& rows);

  //! Selects the eye at `offset` M to the right of the head, for which FlatShadow::eye_edge
  //! returned `edge`.
  void set_eye(double offset, const std::vector<float>& edge);

  //! Draws the near field over rows of the selected eye's picture in host memory: four floats per
  //! pixel. `view` is that of the head, with the projection of the eye.
  void draw(const PictureView& view, const RowBlock& rows, float* rgba);

 private:
  [[nodiscard]] FlatEyeBatch batch_for(const PictureView& view) const;
  [[nodiscard]] double farthest_r() const;
  //! Returns the maximum nearness (1 / affine distance) up to which things at r <= `farthest_r` are
  //! searched for [1/M]: the largest that they can have, but at most 0.9 / |offset of the eye|.
  [[nodiscard]] double max_nearness(double farthest_r) const;
  //! Returns the objects as seen by the current eye.
  [[nodiscard]] ObjectLayer look_at_objects(const PictureView& view, const RowBlock& rows) const;
  //! Does the same as draw(), for rows in the backend's memory.
  void draw_over(const PictureView& view, const RowBlock& rows, float* rgba);

  Backend backend_;
  const NearField& near_field_;
  const FlatShadow& shadow_;
  CameraStation station_;
  double offset_ = 0.0;
  FlatHorizon horizon_{};
  Buffer<float> edge_;
  Buffer<float> nearness_;
  Buffer<float>& rows_;
};

}  // namespace ergodome
