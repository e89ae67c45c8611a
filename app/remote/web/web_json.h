#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/playback/transport.h"
#include "app/remote/common/log_ring.h"

namespace ergodome {

//! Returns the status as a JSON object with the names of its members as keys, and `refused`: the
//! commands that the running show cannot perform, with the reasons. Non-finite numbers become null,
//! invalid UTF-8 the replacement character.
std::string status_json(const PlayerStatus& status);

//! Returns log lines as a JSON array of {"number", "time_ms", "level", "text"}; `time_ms` is since
//! 1970.
std::string log_json(const std::vector<LogLine>& lines);

//! Returns {"error": "..."}, or {"ok": true} if the text is empty.
std::string answer_json(const std::string& error);

//! Maximum size of a command [bytes].
inline constexpr std::size_t largest_json_command = 4096;

//! Parses a command sent by the status page: {"kind": "seek", "value": 12.5}, {"kind": "language",
//! "text": "de"}. `kind` is a name in command_rules(); `value` is a number or a Boolean. Throws
//! Error for other keys, other types, and commands that are too long or nested.
TransportCommand parse_json_command(std::string_view text, const PlayerStatus& status);

}  // namespace ergodome
