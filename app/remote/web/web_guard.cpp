#include "app/remote/web/web_guard.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>

namespace ergodome {

namespace {

constexpr std::string_view cookie_name = "ergodome_token=";
constexpr std::string_view bearer = "Bearer ";

std::string name_in_lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

//! Returns the host of "HOST:PORT", "[HOST]:PORT" or "HOST", in lower case.
std::string host_without_port(const std::string& header) {
  if (header.starts_with('[')) {
    const std::size_t end = header.find(']');
    return end == std::string::npos ? "" : name_in_lower_case(header.substr(1, end - 1));
  }
  return name_in_lower_case(header.substr(0, header.find(':')));
}

//! Returns the value of our cookie in "a=1; ergodome_token=...; b=2".
std::string_view token_cookie(std::string_view header) {
  while (!header.empty()) {
    const std::size_t end = std::min(header.find(';'), header.size());
    std::string_view cookie = header.substr(0, end);
    cookie.remove_prefix(std::min(cookie.find_first_not_of(' '), cookie.size()));
    if (cookie.starts_with(cookie_name)) {
      return cookie.substr(cookie_name.size());
    }
    header.remove_prefix(std::min(end + 1, header.size()));
  }
  return {};
}

//! Returns the value of a header; `name` is in lower case. Empty if it is missing.
std::string_view header_value(std::string_view head, std::string_view name) {
  while (!head.empty()) {
    std::string_view line = head.substr(0, head.find("\r\n"));
    head.remove_prefix(std::min(line.size() + 2, head.size()));
    if (line.size() > name.size() && line[name.size()] == ':' &&
        name_in_lower_case(std::string(line.substr(0, name.size()))) == name) {
      line.remove_prefix(name.size() + 1);
      line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
      return line.substr(0, line.find_last_not_of(" \t") + 1);
    }
  }
  return {};
}

std::string short_answer(std::string_view status, std::string_view text) {
  return fmt::format(
      "HTTP/1.1 {}\r\nContent-Type: text/plain; charset=utf-8\r\nContent-Length: {}\r\nCache-Control: no-store\r\n"
      "Connection: close\r\n\r\n{}",
      status, text.size(), text);
}

bool is_json(const std::string& content_type) {
  const std::string type = name_in_lower_case(content_type.substr(0, content_type.find(';')));
  return type == "application/json" || type == "application/json ";
}

}  // namespace

bool same_in_constant_time(std::string_view a, std::string_view b) {
  // The loop depends on the length of the given text, which its sender knows, but not on that of
  // the token.
  unsigned difference = a.size() == b.size() ? 0U : 1U;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const unsigned char other = b.empty() ? 0 : static_cast<unsigned char>(b[i % b.size()]);
    difference |= static_cast<unsigned>(static_cast<unsigned char>(a[i]) ^ other);
  }
  return difference == 0;
}

std::string no_token_answer(std::string_view head) {
  const std::string answer = short_answer("401 Unauthorized", no_token_text);
  return head.starts_with("HEAD ") ? answer.substr(0, answer.size() - no_token_text.size()) : answer;
}

std::string busy_answer() {
  return short_answer("503 Service Unavailable", "Ergodome: too many connections; close other tabs of this page.\n");
}

WebGuard::WebGuard(std::string token) : token_(std::move(token)) {
  std::array<char, 256> name = {};
  if (::gethostname(name.data(), name.size() - 1) == 0) {
    machine_ = name_in_lower_case(name.data());
  }
}

bool WebGuard::is_token(std::string_view given) const {
  return !token_.empty() && !given.empty() && same_in_constant_time(given, token_);
}

bool WebGuard::is_known_host(const std::string& host, bool is_loopback) const {
  const std::string name = host_without_port(host);
  if (name == "localhost" || NetAddress::parse(name, 0).has_value()) {
    return true;
  }
  return !is_loopback && !machine_.empty() && (name == machine_ || name == machine_ + ".local");
}

WebVerdict WebGuard::judge(const WebAsker& asker) const {
  const bool local = asker.peer.is_loopback();
  const std::string_view authorization = asker.authorization;
  const bool by_header = authorization.starts_with(bearer) && is_token(authorization.substr(bearer.size()));
  const bool by_cookie = is_token(token_cookie(asker.cookie));
  const bool by_url = is_token(asker.url_token);
  if (!local && !by_header && !by_cookie && !by_url) {
    return WebVerdict::no_token;
  }
  const bool foreign_origin = !asker.origin.empty() && asker.origin != "http://" + asker.host;
  // A link on another site may lead to the page, but may neither change anything nor read its
  // streams.
  const bool foreign_use = (asker.changes_something || asker.for_programs) && !asker.fetch_site.empty() &&
                           asker.fetch_site != "same-origin" && asker.fetch_site != "none";
  if (!is_known_host(asker.host, local) || foreign_origin || foreign_use) {
    return WebVerdict::wrong_site;
  }
  if (asker.changes_something && !is_json(asker.content_type)) {
    return WebVerdict::wrong_type;
  }
  return by_url ? WebVerdict::welcome_by_url : WebVerdict::welcome;
}

bool WebGuard::has_token(std::string_view head) const {
  // Reads the query of "GET /path?query HTTP/1.1". judge() checks the same query again and decides.
  const std::string_view target = head.substr(0, head.find("\r\n"));
  constexpr std::string_view name = "token=";
  for (std::size_t at = target.find_first_of("?&"); at < target.size(); at = target.find_first_of("?&", at + 1)) {
    const std::string_view rest = target.substr(at + 1);
    if (rest.starts_with(name) && is_token(rest.substr(name.size(), rest.find_first_of("& #") - name.size()))) {
      return true;
    }
  }
  const std::string_view authorization = header_value(head, "authorization");
  return (authorization.starts_with(bearer) && is_token(authorization.substr(bearer.size()))) ||
         is_token(token_cookie(header_value(head, "cookie")));
}

std::string WebGuard::set_cookie() const {
  constexpr int year_s = 365 * 24 * 3600;
  return std::string(cookie_name) + token_ + "; Path=/; Max-Age=" + std::to_string(year_s) +
         "; HttpOnly; SameSite=Strict";
}

}  // namespace ergodome
