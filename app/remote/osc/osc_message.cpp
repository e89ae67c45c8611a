#include "app/remote/osc/osc_message.h"

#include <fmt/format.h>
#include <lo/lo.h>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <memory>
#include <string_view>

#include "kernels/core/error.h"

namespace ergodome {

namespace {

constexpr std::string_view bundle_head{"#bundle\0", 8};
constexpr std::size_t bundle_head_bytes = 16;  // including the time tag
constexpr int max_arguments = 16;

struct FreeMessage {
  void operator()(lo_message message) const { lo_message_free(message); }
};
using MessageOwner = std::unique_ptr<std::remove_pointer_t<lo_message>, FreeMessage>;

[[noreturn]] void refuse(const std::string& problem) {
  throw Error("OSC packet", problem, "see reference/osc.md in the documentation");
}

std::uint32_t big_endian(std::span<const std::byte> bytes) {
  std::uint32_t number = 0;
  for (const std::byte byte : bytes.first(4)) {
    number = (number << 8U) | std::to_integer<std::uint32_t>(byte);
  }
  return number;
}

//! Returns the problem behind an error code of liblo.
std::string problem_of(int code) {
  switch (code) {
    case LO_EINVALIDPATH:
      return "has an address that is not padded with zeros to a multiple of four bytes";
    case LO_ENOTYPE:
    case LO_EBADTYPE:
      return "has arguments without type tags";
    case LO_EINVALIDTYPE:
      return "has type tags that are not padded with zeros to a multiple of four bytes";
    case LO_EINVALIDARG:
      return "has an argument that is truncated or does not match its type tag";
    case LO_ESIZE:
      return "has a size that does not match its type tags";
    case LO_ETERM:
      return "has a string that is not terminated by a zero";
    case LO_EPAD:
      return "has a string that is not padded with zeros to a multiple of four bytes";
    case LO_TOOBIG:
      return "is too large";
    default:
      return fmt::format("is malformed (liblo error {})", code);
  }
}

//! Reads a number from a packet, where it may be aligned to only four bytes.
template <class Number>
double number_at(const void* position) {
  Number number;
  std::memcpy(&number, position, sizeof number);
  return static_cast<double>(number);
}

OscArgument argument_of(char type, const void* position) {
  switch (type) {
    case LO_INT32:
      return number_at<std::int32_t>(position);
    case LO_INT64:
      return number_at<std::int64_t>(position);
    case LO_FLOAT:
      return number_at<float>(position);
    case LO_DOUBLE:
      return number_at<double>(position);
    case LO_STRING:
    case LO_SYMBOL:
      return std::string(static_cast<const char*>(position));
    case LO_TRUE:
      return true;
    case LO_FALSE:
      return false;
    case LO_NIL:
    case LO_INFINITUM:  // a trigger without a value
      return std::monostate{};
    default:
      refuse(fmt::format("has a first argument of the unsupported type '{}'",
                         std::isprint(static_cast<unsigned char>(type)) ? type : '?'));
  }
}

//! Returns whether a message consists only of an address: older senders omit the type tags of
//! messages without arguments, and OSC 1.0 requires receivers to accept that.
bool is_bare_address(std::span<const std::byte> bytes) {
  const auto end = std::ranges::find(bytes, std::byte{0});
  const auto length = static_cast<std::size_t>(end - bytes.begin());
  constexpr std::size_t word = 4;
  return end != bytes.end() && bytes.size() == (length / word + 1) * word &&
         std::all_of(end, bytes.end(), [](std::byte byte) { return byte == std::byte{0}; });
}

//! Returns the size of a zero-terminated text padded to four bytes, from `at` on; 0 if it is not
//! terminated.
std::size_t text_size(std::span<const std::byte> bytes, std::size_t at) {
  const auto rest = bytes.subspan(std::min(at, bytes.size()));
  const auto end = std::ranges::find(rest, std::byte{0});
  return end == rest.end() ? 0 : (static_cast<std::size_t>(end - rest.begin()) / 4 + 1) * 4;
}

constexpr char colour = 'r';

//! Returns the type tags of a message without the brackets of arrays, whose elements are stored
//! consecutively. In the message, removes these brackets and tags colors, which have four bytes, as
//! integers: liblo rejects arrays and colors.
std::string take_tags(std::vector<std::byte>& message) {
  const std::size_t start = text_size(message, 0);
  const std::size_t size = text_size(message, start);
  if (start == 0 || size == 0 || start + size > message.size() || message[start] != std::byte{','}) {
    return {};
  }
  std::string tags(reinterpret_cast<const char*>(message.data()) + start + 1);
  std::erase_if(tags, [](char tag) { return tag == '[' || tag == ']'; });
  std::string known = "," + tags;
  std::ranges::replace(known, colour, static_cast<char>(LO_INT32));
  known.resize((known.size() / 4 + 1) * 4);
  const auto* const bytes = reinterpret_cast<const std::byte*>(known.data());
  const auto position = message.begin() + static_cast<std::ptrdiff_t>(start);
  message.insert(message.erase(position, position + static_cast<std::ptrdiff_t>(size)), bytes, bytes + known.size());
  return tags;
}

bool is_understood(char type) { return std::string_view("ihfdsSTFNI").find(type) != std::string_view::npos; }

OscMessage message_of(std::span<const std::byte> bytes, OscTime time) {
  if (bytes.empty()) {
    refuse("is empty");
  }
  if (bytes[0] != std::byte{'/'}) {
    refuse("has an address that does not begin with /");
  }
  // liblo converts the byte order in its own copy, but takes a non-const pointer.
  std::vector<std::byte> copy(bytes.begin(), bytes.end());
  if (is_bare_address(bytes)) {
    copy.insert(copy.end(), {std::byte{','}, std::byte{0}, std::byte{0}, std::byte{0}});
  }
  const std::string types = take_tags(copy);
  int problem = 0;
  const MessageOwner message(lo_message_deserialise(copy.data(), copy.size(), &problem));
  if (message == nullptr) {
    refuse(problem_of(problem));
  }
  const int count = lo_message_get_argc(message.get());
  if (count > max_arguments) {
    refuse(fmt::format("has more than {} arguments", max_arguments));
  }
  OscMessage result;
  result.time = time;
  // The packet starts with its address; liblo has checked that it ends within the packet.
  result.address = reinterpret_cast<const char*>(copy.data());
  lo_arg** const arguments = lo_message_get_argv(message.get());
  for (std::size_t i = 0; i < std::min(types.size(), static_cast<std::size_t>(count)); ++i) {
    // Further arguments are usually ignored, so any type is accepted.
    const bool is_ignored = i > 0 && !is_understood(types[i]);
    result.arguments.push_back(is_ignored ? OscArgument() : argument_of(types[i], arguments[i]));
  }
  return result;
}

bool is_bundle(std::span<const std::byte> bytes) {
  return bytes.size() >= bundle_head_bytes && std::memcmp(bytes.data(), bundle_head.data(), bundle_head.size()) == 0;
}

//! Adds the messages of an element: a message, or a bundle at a nesting depth.
void add_messages(std::span<const std::byte> bytes, OscTime time, int depth, std::vector<OscMessage>& messages) {
  if (!is_bundle(bytes)) {
    if (messages.size() >= max_osc_messages) {
      refuse(fmt::format("has more than {} messages", max_osc_messages));
    }
    messages.push_back(message_of(bytes, time));
    return;
  }
  if (depth >= deepest_osc_bundle) {
    refuse(fmt::format("has bundles that are nested deeper than {} levels", deepest_osc_bundle));
  }
  const OscTime proper_time = (OscTime{big_endian(bytes.subspan(8))} << 32U) | big_endian(bytes.subspan(12));
  std::span<const std::byte> rest = bytes.subspan(bundle_head_bytes);
  while (!rest.empty()) {
    if (rest.size() < 4 || big_endian(rest) > rest.size() - 4) {
      refuse("has an element that is longer than the packet");
    }
    const std::size_t size = big_endian(rest);
    add_messages(rest.subspan(4, size), proper_time, depth + 1, messages);
    rest = rest.subspan(4 + size);
  }
}

void add(lo_message message, bool value) { value ? lo_message_add_true(message) : lo_message_add_false(message); }
void add(lo_message message, float value) { lo_message_add_float(message, value); }
void add(lo_message message, OscInteger value) { lo_message_add_int32(message, value.value); }
void add(lo_message message, OscDouble value) { lo_message_add_double(message, value.value); }
void add(lo_message message, const std::string& value) { lo_message_add_string(message, value.c_str()); }

std::vector<char> serialised(const OscOutput& output) {
  const MessageOwner message(lo_message_new());
  for (const auto& argument : output.arguments) {
    std::visit([&](const auto& value) { add(message.get(), value); }, argument);
  }
  std::vector<char> bytes(lo_message_length(message.get(), output.address.c_str()));
  lo_message_serialise(message.get(), output.address.c_str(), bytes.data(), nullptr);
  return bytes;
}

}  // namespace

OscTime osc_now() {
  lo_timetag now;
  lo_timetag_now(&now);
  return (OscTime{now.sec} << 32U) | now.frac;
}

double osc_difference_s(OscTime a, OscTime b) {
  // The difference is computed in unsigned integers, so it is also right across the overflow of OSC
  // time in 2036.
  return static_cast<double>(static_cast<std::int64_t>(a - b)) / 4294967296.0;
}

std::vector<OscMessage> parse_osc(std::span<const std::byte> packet) {
  if (packet.size() > largest_osc_packet) {
    refuse(fmt::format("is longer than {} bytes", largest_osc_packet));
  }
  std::vector<OscMessage> messages;
  add_messages(packet, osc_at_once, 0, messages);
  return messages;
}

std::vector<char> osc_packet(std::span<const OscOutput> messages) {
  if (messages.size() == 1) {
    return serialised(messages[0]);
  }
  std::vector<char> packet(bundle_head.begin(), bundle_head.end());
  packet.insert(packet.end(), {0, 0, 0, 0, 0, 0, 0, static_cast<char>(osc_at_once)});
  for (const OscOutput& output : messages) {
    const std::vector<char> bytes = serialised(output);
    const auto size = static_cast<std::uint32_t>(bytes.size());
    for (const unsigned shift : {24U, 16U, 8U, 0U}) {
      packet.push_back(static_cast<char>((size >> shift) & 0xFFU));
    }
    packet.insert(packet.end(), bytes.begin(), bytes.end());
  }
  return packet;
}

}  // namespace ergodome
