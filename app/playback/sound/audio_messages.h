#pragma once

namespace ergodome {

//! Keeps sound and MIDI libraries from writing to the terminal: Ergodome reports failures itself, and a machine without
//! a device would fill its log. Call it before any of them is used; calling it again does nothing.
void silence_sound_libraries();

}  // namespace ergodome
