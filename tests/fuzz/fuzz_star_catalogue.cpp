#include <xxhash.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <sstream>
#include <string>

#include "content/files/bytes.h"
#include "content/stars/star_file.h"
#include "content/stars/star_table.h"
#include "kernels/core/error.h"

namespace {

using Input = std::span<const std::byte>;

std::uint64_t checksum(Input bytes) { return XXH3_64bits(bytes.data(), bytes.size()); }

//! Builds a file in the project's star format from a count and the packed stars. Its checksums are
//! correct, so that the code that runs after their verification is reached.
ergodome::Bytes star_file(Input input) {
  ergodome::ByteReader from(input, "fuzz");
  const auto count = from.number<std::uint32_t>();
  const Input body = from.take(from.left());
  ergodome::ByteWriter file;
  file.append(std::as_bytes(std::span("ERGOSTAR", 8)));
  file.number(std::uint32_t{1});
  file.number(count);
  file.number(static_cast<std::uint64_t>(body.size()));
  file.number(checksum(body));
  file.number(checksum(file.bytes()));
  file.append(body);
  return file.take();
}

void read(std::uint8_t kind, Input input) {
  switch (kind) {
    case 0:
      ergodome::parse_star_file(input, "fuzz.stars");
      break;
    case 1:
      ergodome::parse_star_file(star_file(input), "fuzz.stars");
      break;
    default: {
      std::istringstream stream(std::string(reinterpret_cast<const char*>(input.data()), input.size()));
      ergodome::parse_star_table(stream, "fuzz.csv");
    }
  }
}

}  // namespace

//! The first byte chooses the reader; the rest is the file.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) {
    return 0;
  }
  try {
    read(data[0], std::as_bytes(std::span(data + 1, size - 1)));
  } catch (const ergodome::Error&) {
  }
  return 0;
}
