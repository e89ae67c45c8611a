#include <cstddef>
#include <cstdint>
#include <span>

#include "calibration/warps/pfm.h"
#include "calibration/warps/warp_conversion.h"
#include "kernels/core/error.h"

// The first byte chooses the order of the rows and the direction of v; the rest is a PFM file.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) {
    return 0;
  }
  const auto order = data[0] % 2 == 0 ? ergodome::RowOrder::bottom_up : ergodome::RowOrder::top_down;
  const auto direction =
      data[0] / 2 % 2 == 0 ? ergodome::TextureDirection::downwards : ergodome::TextureDirection::upwards;
  try {
    const ergodome::FloatMap map =
        ergodome::parse_float_map(std::as_bytes(std::span(data + 1, size - 1)), "fuzz", order);
    const ergodome::WarpMesh mesh = ergodome::with_rim(ergodome::warp_from_map(map, direction));
    ergodome::map_from_warp(mesh, map.width, map.height, direction);
  } catch (const ergodome::Error&) {
  }
  return 0;
}
