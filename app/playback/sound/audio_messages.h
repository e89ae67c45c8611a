#pragma once

namespace ergodome {

//! Keeps libraries of sound and MIDI from writing to the terminal by themselves: what fails is said in our own words, and a machine without
//! a device would fill its log. Call it before any of them is used; calling it again does nothing.
void silence_sound_libraries();

}  // namespace ergodome
