#include "app/remote/web/web_server.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <httplib.h>

#include <list>
#include <nlohmann/json.hpp>

#include "app/remote/common/rate_limit.h"
#include "app/remote/web/http_stream.h"
#include "app/remote/web/web_json.h"
#include "tests/support/fake_player.h"
#include "tests/support/raw_client.h"

namespace ergodome {
namespace {

using nlohmann::json;
using test::becomes_true;
using test::RawClient;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

const std::string token = "0123456789abcdef0123456789abcdef";
const char* const json_type = "application/json";

//! A server that listens at an address of this machine, over real sockets.
class WebServerTest : public testing::Test {
 protected:
  WebServerTest() { board_.post(test::example_status()); }

  void start(const std::string& host) {
    server_ = std::make_unique<WebServer>(*NetAddress::parse(host, 0), token, commands_, board_, log_);
  }

  [[nodiscard]] NetAddress address() const { return server_->address(); }
  [[nodiscard]] httplib::Client client() const {
    httplib::Client client(address().host(), address().port());
    client.set_read_timeout(10);
    return client;
  }

  //! Sends bytes, and returns the server's answer until it closes the connection.
  std::string answer_to(const std::string& bytes) const {
    RawClient raw(address());
    raw.send(bytes);
    return raw.receive_all();
  }

  CommandQueue commands_;
  StatusBoard board_;
  std::shared_ptr<LogRing> log_ = std::make_shared<LogRing>();
  std::unique_ptr<WebServer> server_;
};

class OnLoopback : public WebServerTest {
 protected:
  void SetUp() override { start("127.0.0.1"); }
};

TEST_F(OnLoopback, TheStatusIsJson) {
  const auto answer = client().Get("/api/status");
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->status, 200);
  EXPECT_EQ(json::parse(answer->body).at("title"), "Once around");
}

TEST_F(OnLoopback, CommandsReachTheQueue) {
  const auto answer = client().Post("/api/command", R"({"kind": "exposure", "value": 1.5})", json_type);
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->status, 200);
  const std::deque<TransportCommand> commands = commands_.take_all();
  ASSERT_THAT(commands, testing::ElementsAre(TransportCommand{TransportCommand::Kind::exposure, 1.5, ""}));
  EXPECT_EQ(commands[0].source, "web 127.0.0.1");
}

TEST_F(OnLoopback, WhatIsRefusedIsSaidAndDoesNothing) {
  const auto bad = client().Post("/api/command", R"({"kind": "exposure", "value": 1e9})", json_type);
  ASSERT_TRUE(bad);
  EXPECT_EQ(bad->status, 400);
  EXPECT_THAT(json::parse(bad->body).at("error"), HasSubstr("out of range"));
  EXPECT_EQ(client().Post("/api/command", R"({"kind": "play"})", "text/plain")->status, 415);
  EXPECT_EQ(client().Get("/api/command")->status, 404);
  EXPECT_EQ(client().Post("/api/command", std::string(largest_json_command + 1, ' '), json_type)->status, 413);
  EXPECT_TRUE(commands_.take_all().empty());
}

TEST_F(OnLoopback, OtherSitesAreRefused) {
  EXPECT_EQ(client().Get("/", {{"Host", "evil.example"}})->status, 403);
  EXPECT_EQ(client().Get("/api/events", {{"Origin", "http://evil.example"}})->status, 403);
  const httplib::Headers foreign = {{"Origin", "http://evil.example"}};
  EXPECT_EQ(client().Post("/api/command", foreign, R"({"kind": "play"})", json_type)->status, 403);
  EXPECT_TRUE(commands_.take_all().empty());
}

TEST_F(OnLoopback, StreamsAreNotForOtherSites) {
  for (const char* site : {"cross-site", "same-site"}) {
    EXPECT_EQ(client().Get("/api/events", {{"Sec-Fetch-Site", site}})->status, 403) << site;
    EXPECT_EQ(client().Get("/api/status", {{"Sec-Fetch-Site", site}})->status, 403) << site;
    EXPECT_EQ(client().Get("/", {{"Sec-Fetch-Site", site}})->status, 200) << "a link may lead to the page";
  }
  EXPECT_EQ(client().Get("/api/status", {{"Sec-Fetch-Site", "same-origin"}})->status, 200);
}

TEST_F(OnLoopback, ThePageIsWholeAndNamesNothingOutside) {
  const auto page = client().Get("/");
  ASSERT_TRUE(page);
  EXPECT_THAT(page->body, StartsWith("<!doctype html>"));
  EXPECT_THAT(page->get_header_value("Content-Security-Policy"), HasSubstr("default-src 'none'"));
  for (const char* file : {"/index.html", "/style.css", "/page.js", "/connection.js", "/controls.js", "/graph.js"}) {
    const auto answer = client().Get(file);
    ASSERT_TRUE(answer) << file;
    EXPECT_EQ(answer->status, 200) << file;
    EXPECT_THAT(answer->body, Not(HasSubstr("http"))) << file;
  }
  EXPECT_EQ(client().Get("/../CMakeLists.txt")->status, 404);
}

TEST_F(OnLoopback, TheLogGoesOnFromALine) {
  log_->push(spdlog::level::info, "first", std::chrono::system_clock::now());
  log_->push(spdlog::level::warn, "second", std::chrono::system_clock::now());
  EXPECT_EQ(json::parse(client().Get("/api/log")->body).size(), 2U);
  const json rest = json::parse(client().Get("/api/log?after=1")->body);
  ASSERT_EQ(rest.size(), 1U);
  EXPECT_EQ(rest[0].at("text"), "second");
}

TEST_F(OnLoopback, TheLogAfterWhatIsNoLineIsRefused) {
  for (const char* after : {"-1", "abc", "", "1x", "1.5", "99999999999999999999"}) {
    const auto answer = client().Get(std::string("/api/log?after=") + after);
    ASSERT_TRUE(answer) << after;
    EXPECT_EQ(answer->status, 400) << after;
    EXPECT_THAT(json::parse(answer->body).at("error"), HasSubstr("not a line number")) << after;
  }
}

TEST_F(OnLoopback, EventsGoOnAndOn) {
  RawClient raw(address());
  raw.send("GET /api/events HTTP/1.1\r\nHost: localhost\r\n\r\n");
  EXPECT_THAT(raw.receive_until("Once around"), HasSubstr("event: status"));
  PlayerStatus status = test::example_status();
  status.title = "Another show";
  board_.post(status);
  EXPECT_THAT(raw.receive_until("Another show"), HasSubstr("Another show"));
}

TEST(RateLimit, LetsABurstPassAndThenItsRate) {
  RateLimit limit(100.0, 200.0);
  std::chrono::steady_clock::time_point now(std::chrono::seconds(10));
  int allowed = 0;
  for (int i = 0; i < 1000; ++i) {
    allowed += limit.allows(now) ? 1 : 0;
  }
  EXPECT_EQ(allowed, 200);
  for (int i = 0; i < 1000; ++i) {
    now += std::chrono::milliseconds(1);
    allowed += limit.allows(now) ? 1 : 0;
  }
  EXPECT_NEAR(allowed, 300, 1);
}

TEST_F(OnLoopback, AFloodOfCommandsIsHeldBack) {
  const auto begin = std::chrono::steady_clock::now();
  int accepted = 0;
  for (int i = 0; i < 400; ++i) {
    accepted += client().Post("/api/command", R"({"kind": "play"})", json_type)->status == 200 ? 1 : 0;
  }
  // On a busy machine, sending takes longer than the server's limit of 100 commands per second
  // requires, so that more of them are accepted.
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
  EXPECT_LE(accepted, 201.0 + 100.0 * elapsed.count());
}

TEST_F(OnLoopback, HeadsThatAreTooLongOrOddAreNotAnswered) {
  const std::string start = "GET /api/status HTTP/1.1\r\nHost: localhost\r\n";
  EXPECT_EQ(answer_to(start + "X: " + std::string(HttpStream::max_head_bytes, 'x') + "\r\n\r\n"), "");
  std::string many = start;
  for (std::size_t i = 0; i <= HttpStream::max_head_lines; ++i) {
    many += "X: y\r\n";
  }
  EXPECT_EQ(answer_to(many + "\r\n"), "");
  EXPECT_EQ(answer_to(start + "X: a\nRange: bytes=0-1\r\n\r\n"), "");
  EXPECT_EQ(answer_to(start + "Transfer-Encoding: chunked\r\n\r\n0\r\n\r\n"), "");
}

TEST_F(OnLoopback, RangesAndCompressionAreNotForThisPage) {
  std::string ranges = "Range: bytes=0-1";
  for (int i = 0; i < 1000; ++i) {
    ranges += ",0-1";
  }
  const std::string answer =
      answer_to("GET /style.css HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\nAccept-Encoding: gzip\r\n" +
                ranges + "\r\n\r\n");
  EXPECT_THAT(answer, StartsWith("HTTP/1.1 200"));
  EXPECT_THAT(answer, Not(HasSubstr("gzip")));
}

TEST_F(OnLoopback, GarbageDoesNotEndTheServer) {
  const std::string to_command = "POST /api/command HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\n";
  std::list<RawClient> senders;
  for (const std::string& bytes :
       {std::string("\r\n\r\n"), std::string("GET\r\n\r\n"), std::string(5000, '\0') + "\r\n\r\n",
        to_command + "Content-Length: -1\r\n\r\n", to_command + "Content-Length: 99999999999999999999\r\n\r\n{}",
        std::string("GET /%00%ff?%=%&&= HTTP/1.1\r\nHost: %\r\n\r\n")}) {
    senders.emplace_back(address()).send(bytes);
  }
  EXPECT_EQ(client().Get("/api/status")->status, 200);
  EXPECT_TRUE(commands_.take_all().empty());
}

TEST_F(OnLoopback, ClientsThatSendNothingDoNotKeepOthersOut) {
  std::list<RawClient> silent;
  for (std::size_t i = 0; i < 2 * WebLobby::max_waiting; ++i) {
    silent.emplace_back(address()).send("GET / HT");
  }
  // The server drops the silent clients when their time for sending a request head is over.
  EXPECT_TRUE(becomes_true([&] {
    const auto answer = client().Get("/api/status");
    return answer && answer->status == 200;
  }));
}

TEST_F(OnLoopback, ItEndsWithAnOpenStreamAndAStalledClient) {
  RawClient stream(address());
  stream.send("GET /api/events HTTP/1.1\r\nHost: localhost\r\n\r\n");
  stream.receive_until("event: status");
  RawClient stalled(address());
  stalled.send(
      "POST /api/command HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\nContent-Length: "
      "100\r\n\r\n{");
  RawClient idle(address());
  // A client that subscribes to events but never reads them: the buffers of its connection fill up.
  RawClient full(address());
  full.send("GET /api/events HTTP/1.1\r\nHost: localhost\r\n\r\n");
  const auto begin = std::chrono::steady_clock::now();
  server_.reset();
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(2));
}

//! Tests of a server that listens at an address which other machines can reach.
class FromOutside : public WebServerTest {
 protected:
  void SetUp() override {
    const std::vector<NetAddress> addresses = outward_addresses();
    if (addresses.empty()) {
      GTEST_SKIP() << "this machine has no address but loopback";
    }
    start(addresses.front().host());
    ASSERT_FALSE(address().is_loopback());
  }
};

TEST_F(FromOutside, NothingIsShownWithoutTheToken) {
  for (const char* path : {"/", "/index.html", "/page.js", "/style.css", "/icon.svg", "/api/status", "/api/log",
                           "/api/events", "/api/command", "/nothing", "/?token=", "/?token=wrong",
                           "/api/events?token=0123456789abcdef0123456789abcdeF"}) {
    const auto answer = client().Get(path);
    ASSERT_TRUE(answer) << path;
    EXPECT_EQ(answer->status, 401) << path;
    EXPECT_EQ(answer->body, no_token_text) << path;
    EXPECT_FALSE(answer->has_header("Set-Cookie")) << path;
  }
  EXPECT_EQ(client().Post("/api/command", R"({"kind": "play"})", json_type)->status, 401);
  EXPECT_EQ(client().Options("/api/command")->status, 401);
  EXPECT_TRUE(commands_.take_all().empty());
}

TEST_F(FromOutside, PretendingToBeLocalDoesNotHelp) {
  const httplib::Headers lies = {{"Host", "localhost"},
                                 {"X-Forwarded-For", "127.0.0.1"},
                                 {"Forwarded", "for=127.0.0.1"},
                                 {"REMOTE_ADDR", "127.0.0.1"}};
  EXPECT_EQ(client().Get("/api/status", lies)->status, 401);
}

TEST_F(FromOutside, ARequestBehindARefusedOneIsJudgedForItself) {
  const std::string refused = answer_to(
      "POST /api/command HTTP/1.1\r\nHost: x\r\nContent-Length: 40\r\n\r\n"
      "GET /api/status HTTP/1.1\r\nHost: x\r\n\r\n");
  EXPECT_THAT(refused, StartsWith("HTTP/1.1 401"));
  EXPECT_THAT(refused, Not(HasSubstr("Once around")));
}

TEST_F(FromOutside, TheTokenOpensByUrlAndStaysInACookie) {
  const auto first = client().Get("/?token=" + token);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->status, 200);
  EXPECT_THAT(first->body, Not(HasSubstr(token)));
  const std::string cookie = first->get_header_value("Set-Cookie");
  EXPECT_THAT(cookie, HasSubstr("HttpOnly"));
  const auto page = client().Get("/", {{"Cookie", cookie.substr(0, cookie.find(';'))}});
  EXPECT_EQ(page->status, 200);
  EXPECT_THAT(page->body, HasSubstr("<main>"));
}

TEST_F(FromOutside, TheTokenOpensByHeader) {
  EXPECT_EQ(client().Get("/api/status", {{"Authorization", "Bearer " + token}})->status, 200);
  const httplib::Headers headers = {{"Authorization", "Bearer " + token}};
  EXPECT_EQ(client().Post("/api/command", headers, R"({"kind": "play"})", json_type)->status, 200);
  EXPECT_EQ(commands_.take_all().size(), 1U);
}

TEST_F(FromOutside, AServerForLoopbackIsNotThere) {
  start("127.0.0.1");
  RawClient raw(outward_addresses().front().with_port(server_->address().port()));
  EXPECT_FALSE(raw.is_connected());
}

}  // namespace
}  // namespace ergodome
