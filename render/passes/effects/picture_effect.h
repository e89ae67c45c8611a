#pragma once

#include "render/passes/pass.h"

namespace ergodome {

//! A pass that changes finished pictures by a function and has no memory of its own.
class PictureEffect : public Pass {
 public:
  //! `wanted`: the picture that was requested, with its projection and its show.
  using Apply = void (*)(Picture& picture, const EyePicture& wanted);

  PictureEffect(const PassKind& kind, Apply apply) : kind_(kind), apply_(apply) {}

  [[nodiscard]] const PassKind& kind() const override { return kind_; }
  std::unique_ptr<PassDrawing> prepare(const EyePicture& picture) override {
    return std::make_unique<Drawing>(apply_, picture);
  }

 private:
  class Drawing : public PassDrawing {
   public:
    Drawing(Apply apply, const EyePicture& wanted) : apply_(apply), wanted_(wanted) {}
    void finish(Picture& picture) override { apply_(picture, wanted_); }

   private:
    Apply apply_;
    const EyePicture& wanted_;
  };

  const PassKind& kind_;
  Apply apply_;
};

}  // namespace ergodome
