#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>

#include "content/tables/pair_table.h"
#include "kernels/core/error.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::istringstream stream(std::string(reinterpret_cast<const char*>(data), size));
  try {
    ergodome::read_pair_table(stream, "fuzz.csv");
  } catch (const ergodome::Error&) {
  }
  return 0;
}
