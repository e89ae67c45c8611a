#pragma once

namespace ergodome::test {

//! True in builds with sanitizers: tests that measure take fewer samples there, because other
//! builds assert the numbers.
#if defined(ERGODOME_SANITIZED)
inline constexpr bool sanitized = true;
#else
inline constexpr bool sanitized = false;
#endif

}  // namespace ergodome::test
