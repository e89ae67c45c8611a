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
  number,        //!< within [least, greatest]
  whole,         //!< the same without a fraction; 1 where it is absent
  flag,          //!< true or false, 1 or 0
  language_tag,  //!< letters, digits, - and _
  chapter        //!< its index from 0, or its title
};

//! Name and argument of a command, as accepted by OSC and by the status page.
struct CommandRule {
  TransportCommand::Kind kind = TransportCommand::Kind::play;
  std::string_view name;
  Argument argument = Argument::none;
  double least = 0.0;
  double greatest = 0.0;
};

//! Returns the rules of all commands.
std::span<const CommandRule> command_rules();

//! Returns the rule of a command's name, or nullptr.
const CommandRule* rule_of(std::string_view name);

//! Returns the known name, or other word, that is closest to a word; empty if none is close.
std::string nearest_command(std::string_view word, std::span<const std::string_view> others = {});

//! The argument that came with a command: nothing, a Boolean, a number or a text.
using CommandArgument = std::variant<std::monostate, bool, double, std::string>;

//! The command, with its argument held to the rule; titles of chapters are looked up in the status. Throws Error with the command's name as
//! its place where the argument is missing, of another type, not finite or out of range, and where the show as it runs cannot do it: its time
//! follows a clock from outside, it has no such chapter or language.
TransportCommand checked_command(const CommandRule& rule, const CommandArgument& argument, const PlayerStatus& status);

//! Returns why the show as it runs refuses a command, whatever comes with it; empty if it does not.
std::string refusal_now(const CommandRule& rule, const PlayerStatus& status);

//! Returns the number; throws Error if it is NaN, infinite or out of range.
double checked_number(std::string_view place, double number, double least, double greatest);

//! Greatest distance of show times from zero [s]: beyond it the show's clock has none.
inline constexpr double greatest_show_time_s = 4e9;
//! Greatest speed, forwards and backwards.
inline constexpr double greatest_speed = 100.0;

}  // namespace ergodome
