#pragma once

#include <memory>
#include <vector>

#include "content/show/show.h"
#include "content/sky/repaired_texels.h"
#include "kernels/shells/shell_look.h"
#include "render/backend/buffer.h"
#include "render/passes/sky/sky_cube.h"

namespace ergodome {

//! A show's shells in the form that kernels read.
class ShellPass {
 public:
  //! The show must have shells. Throws Error where a texture cannot be read.
  ShellPass(const Show& show, Backend backend);

  //! Takes the numbers of a show whose shells have the same textures; what has not changed costs nothing.
  void set_numbers(const Show& show);

  //! Those that are seen at all, the outermost first.
  [[nodiscard]] ShellTable table() const;

  //! The radius of the outermost of these; 0 where there is none [M].
  [[nodiscard]] double outermost_r() const;

  //! Of each shell's texture.
  [[nodiscard]] const std::vector<RepairedTexels>& repaired() const { return repaired_; }

  //! Memory that a shell takes, beside its texture.
  static constexpr long shell_bytes = static_cast<long>(sizeof(float) + sizeof(ShellLook));

 private:
  std::vector<ShellSettings> shells_;
  std::vector<RepairedTexels> repaired_;
  bool shifted_ = false;
  std::vector<std::unique_ptr<SkyCube>> textures_;  //!< one a shell, or none
  Buffer<float> u_;
  Buffer<ShellLook> looks_;
  int count_ = 0;
};

//! Whether a pass that was made for one show can take the numbers of another.
bool same_shell_textures(const Show& a, const Show& b);

}  // namespace ergodome
