#include <cstddef>
#include <cstdint>
#include <span>

#include "app/remote/common/command_rules.h"
#include "app/remote/osc/osc_handler.h"

namespace {

ergodome::PlayerStatus show_with_chapters() {
  ergodome::PlayerStatus status;
  status.chapters = {{0.0, "one", {"one", "eins"}}, {1.0, "two", {"two", "zwei"}}};
  return status;
}

//! Ends the fuzzer with an error if a number is not a valid show time.
void expect_finite(double number) {
  if (!(number >= -ergodome::max_show_time_s && number <= ergodome::max_show_time_s)) {
    __builtin_trap();
  }
}

}  // namespace

// The input is an OSC packet. liblo and the handler process it, including replies and messages that
// are due later. All numbers that reach the player must be finite.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  ergodome::CommandQueue commands;
  ergodome::StatusBoard board;
  board.post(show_with_chapters());
  ergodome::OscHandler handler(commands, board,
                               {.clock =
                                    [](const ergodome::ClockFix& fix) {
                                      expect_finite(ergodome::seconds_of(fix.show_time));
                                      expect_finite(fix.speed);
                                    },
                                .warning = {}});
  const ergodome::OscInstant now = {std::chrono::steady_clock::time_point(std::chrono::seconds(1)),
                                    ergodome::OscTime{1} << 32U};
  const std::span<const std::byte> packet = std::as_bytes(std::span(data, size));
  for (const ergodome::OscDatagram& answer :
       handler.receive(packet, *ergodome::NetAddress::parse("127.0.0.1", 9000), now)) {
    // Our own replies must be readable.
    ergodome::parse_osc(std::as_bytes(std::span(answer.bytes)));
  }
  handler.tick(now.steady + std::chrono::minutes(2));
  for (const ergodome::TransportCommand& command : commands.take_all()) {
    expect_finite(command.value);
  }
  return 0;
}
