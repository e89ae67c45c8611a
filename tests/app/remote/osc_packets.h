#pragma once

#include <lo/lo.h>

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "app/remote/osc/osc_message.h"

// Builds and parses OSC packets for tests.
namespace ergodome::test {

//! Builds a packet with one message by means of liblo, as its clients send it.
template <class... Values>
std::vector<std::byte> packet_of(const std::string& address, const char* types, Values... values) {
  const lo_message message = lo_message_new();
  lo_message_add(message, types, values..., LO_ARGS_END);
  std::vector<std::byte> bytes(lo_message_length(message, address.c_str()));
  lo_message_serialise(message, address.c_str(), bytes.data(), nullptr);
  lo_message_free(message);
  return bytes;
}

//! Builds an OSC bundle that contains the given packets and a time tag.
inline std::vector<std::byte> bundle_of(OscTime time, const std::vector<std::vector<std::byte>>& elements) {
  std::vector<std::byte> bytes;
  for (const char c : std::string("#bundle") + '\0') {
    bytes.push_back(static_cast<std::byte>(c));
  }
  const auto append = [&](std::uint64_t number, int byte_count) {
    for (int i = byte_count - 1; i >= 0; --i) {
      bytes.push_back(static_cast<std::byte>((number >> (8 * static_cast<unsigned>(i))) & 0xFFU));
    }
  };
  append(time, 8);
  for (const std::vector<std::byte>& element : elements) {
    append(element.size(), 4);
    bytes.insert(bytes.end(), element.begin(), element.end());
  }
  return bytes;
}

//! Parses the messages of a packet sent by Ergodome.
inline std::vector<OscMessage> messages_in(const std::vector<char>& packet) {
  return parse_osc(std::as_bytes(std::span(packet)));
}

}  // namespace ergodome::test
