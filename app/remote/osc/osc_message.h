#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace ergodome {

//! An OSC argument: integers and floats become numbers, T and F Booleans, strings and symbols
//! texts, nil and infinitum nothing.
using OscArgument = std::variant<std::monostate, bool, double, std::string>;

//! Time of an OSC bundle: seconds since 1900 in the upper 32 bits, their fraction in the lower
//! ones; 1 means immediately.
using OscTime = std::uint64_t;
inline constexpr OscTime osc_at_once = 1;

//! Returns the machine's time of day as OSC time.
OscTime osc_now();
//! Returns a - b in seconds.
double osc_difference_s(OscTime a, OscTime b);

struct OscMessage {
  std::string address;
  std::vector<OscArgument> arguments;
  OscTime time = osc_at_once;

  bool operator==(const OscMessage&) const = default;
};

//! Maximum size of a packet [bytes], and maximum number of its messages.
inline constexpr std::size_t largest_osc_packet = 8192;
inline constexpr std::size_t max_osc_messages = 64;  //!< per packet
inline constexpr int deepest_osc_bundle = 4;

//! Parses the messages of a packet, which is a message or a bundle. Throws Error for malformed or
//! oversized packets and unsupported types.
std::vector<OscMessage> parse_osc(std::span<const std::byte> packet);

//! A number to send as a 32-bit integer.
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
//! Returns a packet with one message, or a bundle of several to be executed immediately. Booleans
//! are sent as T and F, numbers as floats unless given as OscInteger or OscDouble.
std::vector<char> osc_packet(std::span<const OscOutput> messages);

}  // namespace ergodome
