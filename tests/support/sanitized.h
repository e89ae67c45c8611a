#pragma once

namespace ergodome::test {

//! True in builds with sanitizers. Tests that measure something take fewer samples in such builds,
//! because other builds check the numbers.
#if defined(ERGODOME_SANITIZED)
inline constexpr bool sanitized = true;
#else
inline constexpr bool sanitized = false;
#endif

}  // namespace ergodome::test
