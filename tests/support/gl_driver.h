#pragma once

namespace ergodome::test {

//! Set this before a test loads an OpenGL driver: drivers leak memory and are unloaded before the
//! leak checker can attribute the leaks to them.
inline bool driver_was_loaded = false;

}  // namespace ergodome::test
