#pragma once

namespace ergodome::test {

//! Tests must set this to true before they load an OpenGL driver; LeakSanitizer then reports
//! nothing. Drivers leak memory, and they are unloaded before the leaks could be attributed to
//! them.
inline bool driver_was_loaded = false;

}  // namespace ergodome::test
