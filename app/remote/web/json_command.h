#pragma once

#include <string_view>

#include "app/playback/transport.h"

namespace ergodome {

//! Maximum size of a command [bytes].
inline constexpr std::size_t largest_json_command = 4096;

//! Parses a command sent by the status page: {"kind": "seek", "value": 12.5}, {"kind": "language",
//! "text": "de"}. `kind` is a name in command_rules(); `value` is a number or a Boolean. Throws
//! Error for other keys, other types, and commands that are too long or nested.
TransportCommand parse_json_command(std::string_view text, const PlayerStatus& status);

}  // namespace ergodome
