#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "app/remote/web/web_guard.h"

// The input is the head of an HTTP request. Without the token, no request may open the page, and
// every request must get a complete response.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const ergodome::WebGuard guard("0123456789abcdef");
  const std::string_view head(reinterpret_cast<const char*>(data), size);
  if (guard.has_token(head) && head.find("0123456789abcdef") == std::string_view::npos) {
    std::abort();
  }
  if (!ergodome::no_token_answer(head).starts_with("HTTP/1.1 401")) {
    std::abort();
  }
  return 0;
}
