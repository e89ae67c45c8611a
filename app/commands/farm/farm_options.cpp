#include "app/commands/farm/farm_options.h"

#include <cctype>
#include <charconv>

namespace ergodome {

long memory_mib(const std::string& text) {
  long amount = 0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), amount);
  const std::string unit(end, text.data() + text.size());
  if (problem != std::errc() || amount <= 0 || amount > (1L << 40U) || unit.size() > 1) {
    return 0;
  }
  switch (unit.empty() ? 'M' : std::toupper(static_cast<unsigned char>(unit[0]))) {
    case 'K':
      return (amount + 1023) / 1024;
    case 'M':
      return amount;
    case 'G':
      return amount * 1024;
    case 'T':
      return amount * 1024 * 1024;
    default:
      return 0;
  }
}

}  // namespace ergodome
