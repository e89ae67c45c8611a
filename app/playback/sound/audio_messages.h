#pragma once

namespace ergodome {

//! Prevents sound and MIDI libraries from printing messages: Ergodome reports failures itself, and
//! a machine without a device would fill its log. Call it before using any of them; further calls
//! do nothing.
void silence_sound_libraries();

}  // namespace ergodome
