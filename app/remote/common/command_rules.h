#pragma once

#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "app/playback/transport.h"

namespace ergodome {

//! The argument of a command.
enum class Argument {
  none,
  number,        //!< within [minimum, maximum] of the rule
  whole,         //!< an integer within the range; default 1
  flag,          //!< true or false, 1 or 0
  language_tag,  //!< letters, digits, - and _
  chapter        //!< index from 0, or title
};

//! Name and argument of a command, as accepted by OSC and by the status page.
struct CommandRule {
  TransportCommand::Kind kind = TransportCommand::Kind::play;
  std::string_view name;
  Argument argument = Argument::none;
  double minimum = 0.0;
  double maximum = 0.0;
};

//! Returns the rules of all commands.
std::span<const CommandRule> command_rules();

//! Returns the rule of a command's name, or nullptr.
const CommandRule* rule_of(std::string_view name);

//! Returns the command, or one of `others`, that is closest to a word; empty if none is close.
std::string nearest_command(std::string_view word, std::span<const std::string_view> others = {});

//! The argument sent with a command: nothing, a Boolean, a number or a text.
using CommandArgument = std::variant<std::monostate, bool, double, std::string>;

//! Returns the command with its argument checked against the rule. Looks up titles of chapters in
//! the status. Throws Error, located at the command's name, if the argument is missing, of another
//! type, not finite or out of range, or if the running show cannot perform the command: its time
//! follows an external clock, or it has no such chapter or language.
TransportCommand checked_command(const CommandRule& rule, const CommandArgument& argument, const PlayerStatus& status);

//! Returns why the running show refuses a command with any argument; empty if it does not.
std::string refusal_now(const CommandRule& rule, const PlayerStatus& status);

//! Returns the number; throws Error if it is NaN, infinite or out of range.
double checked_number(std::string_view location, double number, double minimum, double maximum);

//! Limit of show times in both directions [s], which is the range of the show's clock.
inline constexpr double max_show_time_s = 4e9;
//! Maximum factor of the playback speed, forward and backward.
inline constexpr double max_speed = 100.0;

}  // namespace ergodome
