#include "content/fingerprint.h"

#include <fmt/format.h>
#include <xxhash.h>

namespace ergodome {

std::string fingerprint(std::string_view text) { return fmt::format("{:016x}", XXH3_64bits(text.data(), text.size())); }

}  // namespace ergodome
