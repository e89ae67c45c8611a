#pragma once

#include <string>
#include <string_view>

#include "app/remote/common/net_address.h"

namespace ergodome {

//! The parts of a request that show where it comes from.
struct WebAsker {
  NetAddress peer;
  bool changes_something = false;  //!< any method except GET and HEAD
  bool for_programs = false;       //!< a path below /api/
  std::string host;                //!< header Host
  std::string origin;              //!< header Origin; empty if missing
  std::string fetch_site;          //!< header Sec-Fetch-Site
  std::string content_type;
  std::string authorization;
  std::string cookie;
  std::string url_token;  //!< URL parameter `token`
};

enum class WebVerdict {
  welcome,
  //! The URL's token is valid: it is moved to a cookie, so that it disappears from the address bar.
  welcome_by_url,
  no_token,    //!< 401: no valid token
  wrong_site,  //!< 403: sent by a page of another site, or for an unknown host name
  wrong_type   //!< 415: the request changes something, but its content is not JSON
};

//! Decides who may see and use the status page.
//!
//! The loopback address of this machine is always allowed; other addresses need the token. A page
//! of another site may make a browser send requests, even on this machine. Therefore `Host` must be
//! a numeric address, localhost or (with the token) this machine's name, which defeats DNS
//! rebinding; `Origin` must be this page; and requests that change something must be JSON, which
//! forms of other sites cannot send.
class WebGuard {
 public:
  //! With an empty token, only loopback is allowed.
  explicit WebGuard(std::string token);

  [[nodiscard]] WebVerdict judge(const WebAsker& asker) const;

  //! Returns whether the head of a request (request line and headers, as sent) contains the token
  //! in any of its locations.
  [[nodiscard]] bool has_token(std::string_view head) const;

  //! Returns the value of the header Set-Cookie that stores the token in a browser for a year.
  [[nodiscard]] std::string set_cookie() const;

 private:
  [[nodiscard]] bool is_token(std::string_view given) const;
  [[nodiscard]] bool is_known_host(const std::string& host, bool is_loopback) const;

  std::string token_;
  std::string machine_;
};

//! The text that a browser shows instead of the page without a valid token.
inline constexpr std::string_view no_token_text =
    "Ergodome: this page requires an access token; open the address with ?token=... that the player printed at its "
    "start.\n";

//! Returns the complete answer (401) to a request without the token; `head` is that of the request.
std::string no_token_answer(std::string_view head);
//! Returns the complete answer (503) if all threads are busy.
std::string busy_answer();

//! Compares two texts in a time that does not depend on where they differ.
bool same_in_constant_time(std::string_view a, std::string_view b);

}  // namespace ergodome
