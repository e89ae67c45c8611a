#pragma once

#include <string>
#include <string_view>

#include "app/remote/net_address.h"

namespace ergodome {

//! What a request says about where it comes from.
struct WebAsker {
  NetAddress peer;
  bool changes_something = false;  //!< anything but GET
  bool for_programs = false;       //!< a path below /api/
  std::string host;                //!< header Host
  std::string origin;              //!< header Origin; empty where there is none
  std::string fetch_site;          //!< header Sec-Fetch-Site
  std::string content_type;
  std::string authorization;
  std::string cookie;
  std::string url_token;  //!< parameter `token` of the URL
};

enum class WebVerdict {
  welcome,
  welcome_by_url,  //!< the URL's token is right: to be kept in a cookie, so that it leaves the address bar
  no_token,        //!< 401
  wrong_site,      //!< 403: another web site asks through a browser here
  wrong_type       //!< 415
};

//! Who may see the status page and use it.
//!
//! From this machine's loopback address, anyone; from anywhere else, who has the token. A browser may be made to ask by a page of
//! another site, even on this machine: so `Host` must be an address in digits, localhost or (with the token) this machine's name,
//! which no foreign name resolves past (DNS rebinding); `Origin` must be this page; and what changes something must come as JSON, which
//! no form of another site can send.
class WebGuard {
 public:
  //! An empty token lets nobody in but from loopback.
  explicit WebGuard(std::string token);

  [[nodiscard]] WebVerdict judge(const WebAsker& asker) const;

  //! Whether the head of a request (request line and headers, as they were sent) carries the token in any of its places.
  [[nodiscard]] bool has_token(std::string_view head) const;

  //! Header Set-Cookie that keeps the token.
  [[nodiscard]] std::string set_cookie() const;

 private:
  [[nodiscard]] bool is_token(std::string_view given) const;
  [[nodiscard]] bool is_known_host(const std::string& host, bool is_loopback) const;

  std::string token_;
  std::string machine_;
};

//! What a browser shows in place of the page, where it has no valid token.
inline constexpr std::string_view no_token_text =
    "Ergodome: this page requires an access token; open the address with ?token=... that the player printed at its "
    "start.\n";

//! The whole answer (401) to a request without the token; `head` is that of the request.
std::string no_token_answer(std::string_view head);
//! The whole answer (503) where all threads are busy.
std::string busy_answer();

//! Whether two texts are the same, in a time that tells nothing of where they differ.
bool same_in_constant_time(std::string_view a, std::string_view b);

}  // namespace ergodome
