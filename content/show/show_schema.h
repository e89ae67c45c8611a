#pragma once

#include "content/show/show_key.h"

// The tables of the show file. Each source file of a table declares its keys; show_schema.cpp puts
// them together.
namespace ergodome {

extern const KeyTable<EffectSettings> effect_keys;
extern const KeyTable<FlightSettings> flight_keys;
extern const KeyTable<StereoSettings> stereo_keys;
extern const KeyTable<ToneSettings> tone_keys;

//! Returns the keys of the whole file.
std::span<const ShowKey> show_keys();

}  // namespace ergodome
