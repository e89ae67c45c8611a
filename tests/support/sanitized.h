#pragma once

namespace ergodome::test {

//! Whether the sanitizers look on: tests that measure take fewer samples then, because their numbers are asserted elsewhere.
#if defined(ERGODOME_SANITIZED)
inline constexpr bool sanitized = true;
#else
inline constexpr bool sanitized = false;
#endif

}  // namespace ergodome::test
