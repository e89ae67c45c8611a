#include <cstddef>
#include <cstdint>
#include <string_view>

#include "calibration/formats/warps/bourke_mesh.h"
#include "calibration/formats/warps/foreign_warp.h"
#include "calibration/projectors/projector_picture.h"
#include "calibration/warps/warp_conversion.h"
#include "kernels/core/error.h"

// The format of a warp file is detected from its content; if this fails, the first byte of the
// input chooses it. Any file either contains a warp that can be drawn and written, or throws an
// Error.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using ergodome::WarpFormat;
  constexpr WarpFormat formats[] = {WarpFormat::domeprojection, WarpFormat::obj,    WarpFormat::sciss,
                                    WarpFormat::easyblend,      WarpFormat::simcad, WarpFormat::skyskan};
  const std::string_view whole(reinterpret_cast<const char*>(data), size);
  const auto found = ergodome::format_of_content(whole);
  const bool shown = found && ergodome::is_foreign(*found);
  if (size == 0) {
    return 0;
  }
  const WarpFormat format = shown ? *found : formats[data[0] % std::size(formats)];
  try {
    const ergodome::ForeignWarp warp =
        ergodome::parse_foreign_warp(shown ? whole : whole.substr(1), "fuzz.warp", format);
    ergodome::map_from_warp(warp.mesh, 16, 9, ergodome::TextureDirection::downwards);
    ergodome::parse_bourke_mesh(ergodome::to_bourke_mesh(warp.mesh, 1.6), "again.data", 1.6);
    constexpr std::size_t small = 2000;
    if (warp.view && warp.mesh.nodes.size() < small) {
      ergodome::through_lens(10.0, warp.mesh, warp.view->orientation, warp.view->frustum);
    }
  } catch (const ergodome::Error&) {
  }
  return 0;
}
