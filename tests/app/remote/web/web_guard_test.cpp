#include "app/remote/web/web_guard.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>

#include "app/remote/web/web_token.h"
#include "tests/support/errors.h"
#include "tests/support/folder_test.h"

namespace ergodome {
namespace {

const std::string guard_token = "0123456789abcdef0123456789abcdef";

WebAsker from(const std::string& peer, const std::string& host) {
  WebAsker asker;
  asker.peer = *NetAddress::parse(peer, 40'000);
  asker.host = host;
  return asker;
}

WebAsker outsider() { return from("192.0.2.7", "192.0.2.2:8080"); }
WebAsker insider() { return from("127.0.0.1", "localhost:8080"); }

WebVerdict verdict(const WebAsker& asker) { return WebGuard(guard_token).judge(asker); }

TEST(WebGuard, LetsNobodyInFromOutsideWithoutTheToken) {
  WebAsker asker = outsider();
  EXPECT_EQ(verdict(asker), WebVerdict::no_token);
  asker.url_token = guard_token + "0";
  EXPECT_EQ(verdict(asker), WebVerdict::no_token);
  asker.url_token = guard_token.substr(1);
  EXPECT_EQ(verdict(asker), WebVerdict::no_token);
  asker.url_token.clear();
  asker.authorization = "Basic " + guard_token;
  asker.cookie = "other=" + guard_token + "; xergodome_token=" + guard_token;
  EXPECT_EQ(verdict(asker), WebVerdict::no_token);
}

TEST(WebGuard, AnEmptyTokenIsNoToken) {
  WebAsker asker = outsider();
  asker.authorization = "Bearer ";
  asker.cookie = "ergodome_token=";
  EXPECT_EQ(WebGuard("").judge(asker), WebVerdict::no_token);
  EXPECT_EQ(verdict(asker), WebVerdict::no_token);
}

TEST(WebGuard, TakesTheTokenByUrlCookieAndHeader) {
  WebAsker asker = outsider();
  asker.url_token = guard_token;
  EXPECT_EQ(verdict(asker), WebVerdict::welcome_by_url);
  asker.url_token.clear();
  asker.cookie = "a=b; ergodome_token=" + guard_token + "; c=d";
  EXPECT_EQ(verdict(asker), WebVerdict::welcome);
  asker.cookie.clear();
  asker.authorization = "Bearer " + guard_token;
  EXPECT_EQ(verdict(asker), WebVerdict::welcome);
}

TEST(WebGuard, NeedsNoTokenFromLoopback) {
  for (const char* peer : {"127.0.0.1", "127.8.9.1", "::1", "::ffff:127.0.0.1"}) {
    EXPECT_EQ(verdict(from(peer, "127.0.0.1:8080")), WebVerdict::welcome) << peer;
  }
  for (const char* peer : {"192.0.2.7", "::ffff:192.0.2.7", "fd00::7", "128.0.0.1", "0.0.0.0", "::"}) {
    EXPECT_EQ(verdict(from(peer, "127.0.0.1:8080")), WebVerdict::no_token) << peer;
  }
}

TEST(WebGuard, RefusesNamesThatAnyoneMayPointHere) {
  for (const char* host :
       {"evil.example", "evil.example:8080", "localhost.evil.example", "127.0.0.1.evil.example", ""}) {
    EXPECT_EQ(verdict(from("127.0.0.1", host)), WebVerdict::wrong_site) << host;
  }
  for (const char* host : {"localhost", "LOCALHOST:8080", "127.0.0.1:8080", "[::1]:8080", "192.0.2.2"}) {
    EXPECT_EQ(verdict(from("127.0.0.1", host)), WebVerdict::welcome) << host;
  }
}

TEST(WebGuard, RefusesPagesOfOtherSites) {
  WebAsker asker = insider();
  asker.origin = "http://localhost:8080";
  EXPECT_EQ(verdict(asker), WebVerdict::welcome);
  for (const char* origin : {"http://evil.example", "https://localhost:8080", "http://localhost:9999", "null"}) {
    asker.origin = origin;
    EXPECT_EQ(verdict(asker), WebVerdict::wrong_site) << origin;
  }
}

TEST(WebGuard, ChangesComeAsJsonFromThePageItself) {
  WebAsker asker = insider();
  asker.changes_something = true;
  for (const char* type : {"", "text/plain", "application/x-www-form-urlencoded", "application/jsonx"}) {
    asker.content_type = type;
    EXPECT_EQ(verdict(asker), WebVerdict::wrong_type) << type;
  }
  asker.content_type = "Application/JSON; charset=utf-8";
  EXPECT_EQ(verdict(asker), WebVerdict::welcome);
  asker.fetch_site = "same-origin";
  EXPECT_EQ(verdict(asker), WebVerdict::welcome);
  asker.fetch_site = "cross-site";
  EXPECT_EQ(verdict(asker), WebVerdict::wrong_site);
}

TEST(WebGuard, KeepsTheCookieFromScriptsAndOtherSites) {
  const std::string cookie = WebGuard(guard_token).set_cookie();
  EXPECT_NE(cookie.find("HttpOnly"), std::string::npos);
  EXPECT_NE(cookie.find("SameSite=Strict"), std::string::npos);
}

TEST(WebGuard, ComparesWholeTexts) {
  EXPECT_TRUE(same_in_constant_time("abc", "abc"));
  EXPECT_FALSE(same_in_constant_time("abc", "abd"));
  EXPECT_FALSE(same_in_constant_time("abc", "ab"));
  EXPECT_FALSE(same_in_constant_time("abab", "ab"));
  EXPECT_FALSE(same_in_constant_time("a", ""));
}

class WebToken : public test::FolderTest {};

TEST_F(WebToken, IsNewEachTime) {
  EXPECT_EQ(new_web_token().size(), 32U);
  EXPECT_NE(new_web_token(), new_web_token());
}

TEST_F(WebToken, IsMadeOnceInAFileThatOnlyItsOwnerReads) {
  const std::filesystem::path file = folder_ / "token";
  const std::string made = web_token_in(file);
  EXPECT_EQ(web_token_in(file), made);
  struct stat status = {};
  ASSERT_EQ(::stat(file.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777U, 0600U);
}

TEST_F(WebToken, ReportsAFileThatOthersCanRead) {
  const std::filesystem::path file = folder_ / "token";
  web_token_in(file);
  EXPECT_EQ(web_token_exposure(file), "");
  for (const auto mode : {0640, 0604, 0660}) {
    ::chmod(file.c_str(), static_cast<mode_t>(mode));
    EXPECT_NE(web_token_exposure(file).find("run chmod 600"), std::string::npos) << mode;
  }
}

TEST(WebGuard, FindsTheTokenInAnyPlaceOfAHead) {
  const WebGuard guard(guard_token);
  const std::string get = "GET /api/status HTTP/1.1\r\nHost: x\r\n";
  EXPECT_TRUE(guard.has_token("GET /?token=" + guard_token + " HTTP/1.1\r\nHost: x\r\n\r\n"));
  EXPECT_TRUE(guard.has_token("GET /?a=b&token=" + guard_token + "&c HTTP/1.1\r\n\r\n"));
  EXPECT_TRUE(guard.has_token(get + "COOKIE:  a=b; ergodome_token=" + guard_token + "\r\n\r\n"));
  EXPECT_TRUE(guard.has_token(get + "authorization: Bearer " + guard_token + "\r\n\r\n"));
  EXPECT_FALSE(guard.has_token(get + "\r\n"));
  EXPECT_FALSE(guard.has_token(""));
  EXPECT_FALSE(guard.has_token("GET /?token=" + guard_token + "0 HTTP/1.1\r\n\r\n"));
  EXPECT_FALSE(guard.has_token(get + "X-Authorization: Bearer " + guard_token + "\r\n\r\n"));
  EXPECT_FALSE(guard.has_token(get + "X: ?token=" + guard_token + " \r\n\r\n"));
  EXPECT_FALSE(WebGuard("").has_token("GET /?token= HTTP/1.1\r\n\r\n"));
}

TEST_F(WebToken, IsRefusedWhenItIsShortOrNeedsEscapes) {
  const auto refusal = [](const std::string& text) { return test::error_of([&] { checked_web_token(text, "t"); }); };
  EXPECT_NE(refusal("secret"), "");
  EXPECT_NE(refusal("0123456789abcdef; Path=/x"), "");
  EXPECT_NE(refusal(std::string(129, 'a')), "");
  EXPECT_EQ(refusal("0123456789-._~AZ"), "");
  std::ofstream(folder_ / "bad") << "short\n";
  EXPECT_NE(test::error_of([&] { web_token_in(folder_ / "bad"); }), "");
}

TEST_F(WebToken, IsNeverQuotedWhereItIsRefused) {
  EXPECT_EQ(test::error_of([&] { checked_web_token("pass word that is long", "t"); }).find("pass"), std::string::npos);
}

}  // namespace
}  // namespace ergodome
