#pragma once

#include <string_view>

#include "app/playback/transport.h"

namespace ergodome {

//! Largest command that is read [bytes].
inline constexpr std::size_t largest_json_command = 4096;

//! A command as the page in a browser sends it: {"kind": "seek", "value": 12.5}, {"kind": "language", "text": "de"}. `kind` is a name of
//! command_rules(); `value` a number or a truth. Throws Error where it is not that: other keys, other types, too long, too deep.
TransportCommand parse_json_command(std::string_view text, const PlayerStatus& status);

}  // namespace ergodome
