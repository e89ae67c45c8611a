#pragma once

namespace ergodome::test {

//! To be set before a test loads an OpenGL driver: such keep memory, and are unloaded before the leak checker could tell whose it is.
inline bool driver_was_loaded = false;

}  // namespace ergodome::test
