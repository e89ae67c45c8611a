#include <cstddef>
#include <cstdint>
#include <string_view>

#include "calibration/formats/warps/bourke_mesh.h"
#include "calibration/warps/warp_conversion.h"
#include "kernels/core/error.h"

// Any text is either a mesh that can be drawn and that survives a round trip through its text, or
// throws an Error.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const ergodome::WarpMesh mesh =
        ergodome::parse_bourke_mesh({reinterpret_cast<const char*>(data), size}, "fuzz.data", 1.6);
    const ergodome::WarpMesh again = ergodome::parse_bourke_mesh(ergodome::to_bourke_mesh(mesh, 1.6), "again", 1.6);
    if (again.columns != mesh.columns || again.rows != mesh.rows) {
      __builtin_trap();
    }
    ergodome::mask_from_warp(mesh, 64, 40);
  } catch (const ergodome::Error&) {
  }
  return 0;
}
