#pragma once

#include <memory>
#include <vector>

#include "content/show/show.h"
#include "content/sky/environment_image.h"
#include "kernels/shells/shell_appearance.h"
#include "render/backend/buffer.h"
#include "render/passes/sky/sky_cube.h"

namespace ergodome {

//! The shells of a show in the form that kernels read.
class ShellPass {
 public:
  //! The show must have shells. Throws Error if a texture cannot be read.
  ShellPass(const Show& show, Backend backend);

  //! Applies the numbers of a show whose shells have the same textures as those of the first show.
  //! Does nothing if no number has changed.
  void set_numbers(const Show& show);

  //! Returns the visible shells, outermost first.
  [[nodiscard]] ShellTable table() const;

  //! Returns the radius of the outermost visible shell [M]; 0 if there is none.
  [[nodiscard]] double outermost_r() const;

  //! Returns the numbers of repaired texels in each shell's texture.
  [[nodiscard]] const std::vector<RepairedTexels>& repaired() const { return repaired_; }

  //! Memory of a shell without its texture [bytes].
  static constexpr long shell_bytes = static_cast<long>(sizeof(float) + sizeof(ShellAppearance));

 private:
  std::vector<ShellSettings> shells_;
  std::vector<RepairedTexels> repaired_;
  bool shifted_ = false;
  std::vector<std::unique_ptr<SkyCube>> textures_;  //!< texture of each shell; null if it has none
  Buffer<float> u_;
  Buffer<ShellAppearance> appearances_;
  int count_ = 0;
};

//! Returns whether two shows have the same shell textures, so that a pass made for one can draw the
//! other.
bool same_shell_textures(const Show& a, const Show& b);

}  // namespace ergodome
