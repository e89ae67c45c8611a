#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "calibration/formats/mpcdi/mpcdi_conversion.h"
#include "calibration/formats/mpcdi/mpcdi_reader.h"
#include "calibration/formats/mpcdi/mpcdi_writer.h"
#include "kernels/core/error.h"

namespace {

using ergodome::Mpcdi;
using ergodome::RowOrder;

//! Returns a small warp or mask for any file name in a description, so that the code after the
//! lookup of files is reached.
std::string small_file(const std::string& name, std::size_t) {
  using namespace std::string_literals;
  if (name.ends_with(".png")) {
    return ergodome::to_png({2, 2, 1, 8, {0.0F, 0.2F, 0.4F, 1.0F}}, name);
  }
  return "PF\n2 2\n-1.0\n"s + std::string(48, '\0');
}

Mpcdi parsed(std::uint8_t kind, std::span<const std::byte> input) {
  if (kind % 2 == 0) {
    return ergodome::parse_mpcdi_archive(input, "fuzz.mpcdi", RowOrder::bottom_up);
  }
  return ergodome::parse_mpcdi_description({reinterpret_cast<const char*>(input.data()), input.size()}, "fuzz.xml",
                                           small_file, RowOrder::bottom_up);
}

//! Uses everything that was parsed. Any part either can be used or throws an Error.
void look_at(const Mpcdi& mpcdi) {
  for (const ergodome::MpcdiBuffer& buffer : mpcdi.buffers) {
    for (const ergodome::MpcdiRegion& region : buffer.regions) {
      ergodome::pose_of(region);
      ergodome::lens_of(region);
      try {
        ergodome::warp_of(mpcdi, region, "fuzz");
      } catch (const ergodome::Error&) {
        ergodome::surface_of(mpcdi, region, "fuzz");
      }
    }
  }
}

}  // namespace

// The first byte decides whether the rest is an MPCDI archive or only its XML description. Accepted
// input is written and read again.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) {
    return 0;
  }
  try {
    const Mpcdi mpcdi = parsed(data[0], std::as_bytes(std::span(data + 1, size - 1)));
    const std::string archive = ergodome::to_mpcdi_archive(mpcdi, "again.mpcdi");
    ergodome::parse_mpcdi_archive(std::as_bytes(std::span(archive)), "again.mpcdi", RowOrder::bottom_up);
    look_at(mpcdi);
  } catch (const ergodome::Error&) {
  }
  return 0;
}
