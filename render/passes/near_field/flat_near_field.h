#pragma once

#include "kernels/eyes/flat/draw_flat_eyes.h"
#include "render/lens/flat/flat_shadow.h"
#include "render/passes/near_field/near_field.h"

namespace ergodome {

//! What stands near the hole as eyes of the stereo model `flat` see it, all through one lens: a thing at the affine distance d in the head's direction n
//! stands at d n (kernels/flat_eyes/eye_line.h).
class FlatNearField {
 public:
  //! For the eyes of a head whose shadow is given. The disk is read from NearField::disk_grid where there is one and no object is seen: the head's,
  //! with its nearness.
  //! `rows` is kept from picture to picture: what rows on their way through a GPU take.
  FlatNearField(Backend backend, const NearField& near_field, const EyeCamera& head, const FlatShadow& shadow,
                Buffer<float>& rows);

  //! Turns to an eye `offset` M to the right of the head, which sees the shadow's edge where FlatShadow::eye_edge has it.
  void set_eye(double offset, const std::vector<float>& edge);

  //! Draws it over rows of that eye's picture in host memory: four floats a pixel. The view is the head's, through the eye's own projection.
  void draw(const PictureView& view, const RowBlock& rows, float* rgba);

 private:
  [[nodiscard]] FlatEyeBatch batch_for(const PictureView& view) const;
  [[nodiscard]] double farthest_r() const;
  //! The nearness beyond which nothing within a radius is looked for [1/M].
  [[nodiscard]] double most_nearness(double farthest_r) const;
  //! Objects, as that eye sees them.
  [[nodiscard]] ObjectLayer look_at_objects(const PictureView& view, const RowBlock& rows) const;
  //! As draw, over rows in the backend's memory.
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
