#include "app/remote/osc/osc_server.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <lo/lo.h>
#include <poll.h>

#include <fstream>

#include "tests/app/remote/osc_packets.h"
#include "tests/support/fake_player.h"

namespace ergodome {
namespace {

using test::becomes_true;

//! A fake OSC controller that listens on a UDP socket.
class Controller {
 public:
  explicit Controller(const std::string& host = "127.0.0.1")
      : socket_(bound_socket(SOCK_DGRAM, *NetAddress::parse(host, 0), "test", "")) {}

  void send(const NetAddress& to, const std::vector<std::byte>& bytes) {
    ::sendto(socket_.get(), bytes.data(), bytes.size(), 0, to.get(), to.size());
  }

  //! Returns the messages of the next packet; empty if none arrives.
  std::vector<OscMessage> receive() {
    pollfd polled = {socket_.get(), POLLIN, 0};
    if (::poll(&polled, 1, 10'000) <= 0) {
      return {};
    }
    std::vector<char> packet(10'000);
    packet.resize(
        static_cast<std::size_t>(std::max<ssize_t>(0, ::recv(socket_.get(), packet.data(), packet.size(), 0))));
    return test::messages_in(packet);
  }

  [[nodiscard]] int port() const { return local_address(socket_.get()).port(); }

 private:
  Descriptor socket_;
};

class OscServerTest : public testing::Test {
 protected:
  void start(const std::string& host) {
    server_ = std::make_unique<OscServer>(*NetAddress::parse(host, 0), player_.commands, player_.board, OscListeners());
  }

  test::FakePlayer player_;
  std::unique_ptr<OscServer> server_;
};

TEST_F(OscServerTest, HearsALibloClient) {
  start("127.0.0.1");
  const lo_address client = lo_address_new("127.0.0.1", std::to_string(server_->address().port()).c_str());
  lo_send(client, "/ergodome/exposure", "f", 2.5);
  lo_send(client, "/ergodome/language", "s", "de");
  lo_address_free(client);
  EXPECT_TRUE(becomes_true([&] {
    const PlayerStatus status = player_.board.read();
    return status.exposure_stops == 2.5 && status.language == "de";
  }));
}

TEST_F(OscServerTest, AnswersWhoAsks) {
  start("127.0.0.1");
  Controller controller;
  controller.send(server_->address(), test::packet_of("/ergodome/ping", ""));
  EXPECT_EQ(controller.receive().at(0).address, "/ergodome/pong");
  controller.send(server_->address(), test::packet_of("/ergodome/seek", "s", "soon"));
  EXPECT_EQ(controller.receive().at(0).address, "/ergodome/error");
}

TEST_F(OscServerTest, TellsSubscribersAgainAndAgain) {
  start("127.0.0.1");
  Controller controller;
  Controller display;
  controller.send(server_->address(), test::packet_of("/ergodome/subscribe", "i", display.port()));
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(display.receive().at(0).address, "/ergodome/status/title");
  }
}

TEST_F(OscServerTest, SurvivesGarbageAndGiants) {
  start("127.0.0.1");
  Controller controller;
  for (std::size_t size : {0U, 1U, 7U, 16U, 9000U, 60'000U}) {
    for (const unsigned fill : {0x00U, 0x2FU, 0xFFU}) {
      controller.send(server_->address(), std::vector<std::byte>(size, static_cast<std::byte>(fill)));
    }
  }
  Controller another;
  another.send(server_->address(), test::packet_of("/ergodome/ping", ""));
  EXPECT_EQ(another.receive().at(0).address, "/ergodome/pong");
}

//! Returns whether any process listens on a UDP address, given as in /proc/net/udp:
//! "0100007F:1F90".
bool kernel_lists(const std::string& address_and_port) {
  std::ifstream table("/proc/net/udp");
  for (std::string line; std::getline(table, line);) {
    if (line.find(" " + address_and_port + " ") != std::string::npos) {
      return true;
    }
  }
  return false;
}

TEST_F(OscServerTest, ListensAtLoopbackAlone) {
  start("127.0.0.1");
  const std::string port = fmt::format("{:04X}", server_->address().port());
  EXPECT_TRUE(kernel_lists("0100007F:" + port));
  EXPECT_FALSE(kernel_lists("00000000:" + port));
}

TEST_F(OscServerTest, ListensToTheNetworkWhenItIsAskedTo) {
  const std::vector<NetAddress> addresses = outward_addresses();
  if (addresses.empty()) {
    GTEST_SKIP() << "this machine has no address but loopback";
  }
  const std::string host = addresses.front().host();
  start(host);
  Controller controller(host);
  controller.send(server_->address(), test::packet_of("/ergodome/ping", ""));
  EXPECT_EQ(controller.receive().at(0).address, "/ergodome/pong");
}

}  // namespace
}  // namespace ergodome
