#include "app/remote/remote_control.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <httplib.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "tests/support/errors.h"
#include "tests/support/folder_test.h"

namespace ergodome {
namespace {

using testing::HasSubstr;
using testing::Not;

class RemoteControlTest : public testing::Test {
 protected:
  std::unique_ptr<RemoteControl> started(const RemoteOptions& options) {
    return std::make_unique<RemoteControl>(options, commands_, board_, log_, OscListeners());
  }
  std::string refusal(const RemoteOptions& options) {
    return test::error_of([&] { started(options); });
  }

  CommandQueue commands_;
  StatusBoard board_;
  std::shared_ptr<LogRing> log_ = std::make_shared<LogRing>();
};

RemoteOptions parsed(std::vector<std::string> words) {
  CLI::App app;
  RemoteOptions options;
  add_remote_options(app, options);
  std::reverse(words.begin(), words.end());
  app.parse(words);
  return options;
}

TEST_F(RemoteControlTest, ListensNowhereUnlessAsked) {
  const auto remote = started(parsed({}));
  EXPECT_FALSE(remote->web_address().has_value());
  EXPECT_FALSE(remote->osc_address().has_value());
  EXPECT_TRUE(remote->greeting().empty());
}

TEST_F(RemoteControlTest, ListensAtLoopbackUnlessToldOtherwise) {
  const auto remote = started(parsed({"--web", "0", "--osc", "0"}));
  EXPECT_TRUE(remote->web_address()->is_loopback());
  EXPECT_TRUE(remote->osc_address()->is_loopback());
  EXPECT_THAT(remote->greeting().at(0), Not(HasSubstr("token")));
}

TEST_F(RemoteControlTest, MakesATokenForTheNetworkAndPrintsItsUse) {
  const auto remote = started(parsed({"--web", "0", "--web-bind", "0.0.0.0"}));
  const std::string last = remote->greeting().back();
  if (outward_addresses().empty()) {
    GTEST_SKIP() << "this machine has no address but loopback";
  }
  const std::size_t at = last.find("/?token=");
  ASSERT_NE(at, std::string::npos);
  const NetAddress outward = outward_addresses().front();
  httplib::Client client(outward.host(), remote->web_address()->port());
  EXPECT_EQ(client.Get("/api/status")->status, 401);
  EXPECT_EQ(client.Get("/api/status", {{"Authorization", "Bearer " + last.substr(at + 8)}})->status, 200);
  httplib::Client inside("127.0.0.1", remote->web_address()->port());
  EXPECT_EQ(inside.Get("/api/status")->status, 200) << "loopback needs no token, wherever else the page listens";
  EXPECT_TRUE(log_->after(0).empty()) << "a token in the log";
}

class SavedToken : public test::FolderTest {
 protected:
  //! Starts a status page that is open to the network. Returns its first printed address, which
  //! contains the token, and the warnings.
  std::string start(const std::filesystem::path& file) {
    RemoteOptions options = parsed({"--web", "0", "--web-bind", "0.0.0.0"});
    options.saved_token_file = file;
    CommandQueue commands;
    const StatusBoard board;
    const RemoteControl remote(options, commands, board, std::make_shared<LogRing>(), OscListeners());
    warning_ = remote.warning();
    const std::string last = remote.greeting().back();
    const std::size_t at = last.find("token=");
    return at == std::string::npos ? "" : last.substr(at);
  }

  std::string warning_;
};

TEST_F(SavedToken, IsTheSameAfterARestartAndItsOwnersAlone) {
  if (outward_addresses().empty()) {
    GTEST_SKIP() << "this machine has no address but loopback";
  }
  const std::filesystem::path file = folder_ / "state" / "web-token";
  const std::string first = start(file);
  EXPECT_EQ(first.size(), std::string("token=").size() + 32U);
  EXPECT_EQ(start(file), first);
  EXPECT_EQ(warning_, "");
  EXPECT_EQ(std::filesystem::status(file).permissions(),
            std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
}

TEST_F(SavedToken, ThatOthersMayHaveReadIsWarnedOf) {
  const std::filesystem::path file = folder_ / "web-token";
  start(file);
  std::filesystem::permissions(file, std::filesystem::perms::others_read, std::filesystem::perm_options::add);
  start(file);
  EXPECT_THAT(warning_, HasSubstr("chmod 600"));
}

TEST_F(SavedToken, ThatCannotBeReadDoesNotKeepTheShowFromStarting) {
  std::filesystem::create_directory(folder_ / "web-token");
  const std::string token = start(folder_ / "web-token");
  EXPECT_THAT(warning_, HasSubstr("the saved token cannot be used"));
  EXPECT_EQ(token.empty(), outward_addresses().empty());
}

TEST_F(RemoteControlTest, NamesTheRemedyWhereAPortIsInUse) {
  const auto first = started(parsed({"--web", "0", "--osc", "0"}));
  RemoteOptions same;
  same.web_port = first->web_address()->port();
  EXPECT_THAT(refusal(same), HasSubstr("choose another port with --web"));
  same.web_port.reset();
  same.osc_port = first->osc_address()->port();
  EXPECT_THAT(refusal(same), HasSubstr("choose another port with --osc"));
}

TEST_F(RemoteControlTest, RefusesAddressesThatAreNoneOrNotHere) {
  EXPECT_THAT(refusal(parsed({"--web", "0", "--web-bind", "example.org"})), HasSubstr("not a numeric address"));
  EXPECT_THAT(refusal(parsed({"--osc", "0", "--osc-bind", "198.51.100.7"})), HasSubstr("an address of this machine"));
  EXPECT_THAT(refusal(parsed({"--web", "0", "--web-token", "short"})), HasSubstr("16 to 128"));
  EXPECT_THROW(parsed({"--web", "65536"}), CLI::Error);
}

TEST_F(RemoteControlTest, ChecksSubscribersOfTheCommandLine) {
  const auto with = [](const std::string& subscriber, const std::string& bind) {
    return parsed({"--osc", "0", "--osc-bind", bind, "--osc-subscriber", subscriber});
  };
  EXPECT_EQ(refusal(with("192.0.2.7:9001", "0.0.0.0")), "");
  EXPECT_EQ(refusal(with("127.0.0.1:9001", "127.0.0.1")), "");
  for (const char* const wrong :
       {"192.0.2.7", "192.0.2.7:", "192.0.2.7:0", "host:9001", "fd00::7:9001", "192.0.2.7:9001x"}) {
    EXPECT_THAT(refusal(with(wrong, "0.0.0.0")), HasSubstr("not a numeric address with a port")) << wrong;
  }
  EXPECT_THAT(refusal(with("192.0.2.7:9001", "127.0.0.1")), HasSubstr("cannot reach"));
  EXPECT_THAT(refusal(with("[fd00::7]:9001", "0.0.0.0")), HasSubstr("cannot reach"));
}

TEST_F(RemoteControlTest, AFloodOfOscLeavesTheQueueBounded) {
  const auto remote = started(parsed({"--osc", "0"}));
  const Descriptor socket(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  const NetAddress to = *remote->osc_address();
  const std::string packet("/ergodome/play\0\0,\0\0\0", 20);
  for (int i = 0; i < 20'000; ++i) {
    ::sendto(socket.get(), packet.data(), packet.size(), 0, to.get(), to.size());
  }
  const std::size_t taken = commands_.take_all().size();
  EXPECT_GT(taken, 0U);
  EXPECT_LE(taken, 1024U);
}

}  // namespace
}  // namespace ergodome
