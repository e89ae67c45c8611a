#pragma once

#include <string>
#include <vector>

#include "app/playback/transport.h"
#include "app/remote/log_ring.h"

namespace ergodome {

//! The status as a JSON object whose keys are the members' names, with `refused` beside them: the commands that the show as it runs cannot
//! do, and why. Numbers that are not finite become null, bytes that are no UTF-8 the
//! replacement character.
std::string status_json(const PlayerStatus& status);

//! Lines of the log as a JSON array of {"number", "time_ms", "level", "text"}; `time_ms` is since 1970.
std::string log_json(const std::vector<LogLine>& lines);

//! {"error": "..."}, or {"ok": true} where the text is empty.
std::string answer_json(const std::string& error);

}  // namespace ergodome
