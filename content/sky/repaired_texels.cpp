#include "content/sky/repaired_texels.h"

#include <fmt/format.h>

#include <filesystem>

#include "content/files/counted.h"
#include "content/show/show_errors.h"
#include "kernels/core/error.h"

namespace ergodome {

std::string repair_text(const RepairedTexels& texels) {
  std::string text;
  const auto add = [&](long count, const std::string& what) {
    if (count > 0) {
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", counted(count, "texel"), what);
    }
  };
  add(texels.too_bright, fmt::format("infinite or brighter than {:g} (clamped)", brightest_texel));
  add(texels.below_zero, "with a negative color (set to 0)");
  add(texels.not_numbers, "with a non-finite color (set to black)");
  return text;
}

std::string note_of_repair(const Show& show, const std::string& key, const std::string& name,
                           const RepairedTexels& texels) {
  return named_by(show, key,
                  Error((std::filesystem::path(show.folder) / name).string(), "has " + repair_text(texels),
                        "save the image again without infinite, NaN or negative values"))
      .what();
}

}  // namespace ergodome
