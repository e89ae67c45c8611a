#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace ergodome {

//! An OSC argument: integers and floats are numbers, strings and symbols texts; nil is nothing.
using OscArgument = std::variant<std::monostate, bool, double, std::string>;

//! Time of an OSC bundle: seconds since 1900 in the upper 32 bits, their fraction in the lower ones; 1 is "at once".
using OscTime = std::uint64_t;
inline constexpr OscTime osc_at_once = 1;

//! The machine's time of day as OSC has it.
OscTime osc_now();
//! a - b in seconds.
double osc_difference_s(OscTime a, OscTime b);

struct OscMessage {
  std::string address;
  std::vector<OscArgument> arguments;
  OscTime time = osc_at_once;

  bool operator==(const OscMessage&) const = default;
};

//! Bounds of what is read.
inline constexpr std::size_t largest_osc_packet = 8192;
inline constexpr std::size_t most_osc_messages = 64;  //!< in a packet
inline constexpr int deepest_osc_bundle = 4;

//! The messages of a packet, which is one or a bundle of them. Throws Error for anything else: broken sizes, unknown types, too many.
std::vector<OscMessage> parse_osc(std::span<const std::byte> packet);

//! A packet of one message; of several, a bundle to be heeded at once. Truths are sent as T and F, numbers as floats; a second form of a
//! number is sent by an argument of type OscDouble or OscInteger.
struct OscInteger {
  std::int32_t value = 0;
};
struct OscDouble {
  double value = 0.0;
};
struct OscOutput {
  std::string address;
  std::vector<std::variant<bool, float, OscInteger, OscDouble, std::string>> arguments;
};
std::vector<char> osc_packet(std::span<const OscOutput> messages);

}  // namespace ergodome
