#include "app/remote/web/web_pages.h"

#include <fmt/format.h>

#include <array>
#include <charconv>

#include "app/remote/web/page_files.h"
#include "app/remote/web/web_json.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

using std::chrono::steady_clock;

constexpr std::chrono::milliseconds idle_time{5000};
constexpr int max_requests_a_connection = 200;
const char* const json_type = "application/json; charset=utf-8";
const char* const html_type = "text/html; charset=utf-8";

//! A page that redirects to the status page. An HTTP redirect does not work: browsers do not send a
//! same-site cookie after a redirect that starts at a link in a mail.
const char* const lead_on = "<!doctype html><meta http-equiv=\"refresh\" content=\"0;url=/\"><title>Ergodome</title>";

const char* content_type_of(std::string_view name) {
  return name.ends_with(".css")   ? "text/css; charset=utf-8"
         : name.ends_with(".js")  ? "text/javascript; charset=utf-8"
         : name.ends_with(".svg") ? "image/svg+xml"
                                  : html_type;
}

httplib::Headers safe_headers() {
  return {{"Content-Security-Policy",
           "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self'; connect-src 'self'; base-uri "
           "'none'; form-action 'none'; frame-ancestors 'none'"},
          {"X-Content-Type-Options", "nosniff"},
          {"X-Frame-Options", "DENY"},
          {"Referrer-Policy", "no-referrer"},
          {"Cross-Origin-Resource-Policy", "same-origin"},
          {"Cache-Control", "no-store"}};
}

WebAsker asker_of(const httplib::Request& request) {
  WebAsker asker;
  // The system supplied a numeric address, so parsing succeeds.
  asker.peer = NetAddress::parse(request.remote_addr, request.remote_port).value_or(NetAddress());
  asker.changes_something = request.method != "GET" && request.method != "HEAD";
  asker.for_programs = request.path.starts_with("/api/");
  asker.host = request.get_header_value("Host");
  asker.origin = request.get_header_value("Origin");
  asker.fetch_site = request.get_header_value("Sec-Fetch-Site");
  asker.content_type = request.get_header_value("Content-Type");
  asker.authorization = request.get_header_value("Authorization");
  asker.cookie = request.get_header_value("Cookie");
  asker.url_token = request.get_param_value("token");
  return asker;
}

//! Returns a regular expression that matches only this path.
std::string pattern_of(std::string_view path) {
  std::string pattern;
  for (const char c : path) {
    if (c == '.') {
      pattern += '\\';
    }
    pattern += c;
  }
  return pattern;
}

//! Returns the number of the log line after which the request wants lines; 0 if missing. Throws
//! Error if it is not a number.
std::uint64_t line_before(const httplib::Request& request) {
  std::uint64_t number = 0;
  if (request.has_param("after")) {
    const std::string text = request.get_param_value("after");
    const char* const end = text.data() + text.size();
    if (const auto [stop, problem] = std::from_chars(text.data(), end, number); problem != std::errc{} || stop != end) {
      throw Error("after", "is not a line number of the log", "send 0 or a larger whole number");
    }
  }
  return number;
}

}  // namespace

WebPages::WebPages(const WebGuard& guard, CommandQueue& commands, const StatusBoard& board,
                   std::shared_ptr<const LogRing> log, const StopSignal& stop)
    : guard_(guard), commands_(commands), board_(board), log_(std::move(log)), stop_(stop) {
  // httplib writes long answers only while it has a listening socket. Ours is elsewhere, and the
  // stop signal ends them.
  svr_sock_ = 0;
  keep_alive_timeout_sec_ = idle_time.count() / 1000;
  keep_alive_max_count_ = max_requests_a_connection;
  set_payload_max_length(largest_json_command);
  set_default_headers(safe_headers());
  set_exception_handler(
      [](const httplib::Request&, httplib::Response& response, const std::exception_ptr&) { response.status = 500; });
  set_pre_routing_handler([this](const auto& request, auto& response) { return let_in(request, response); });
  add_files();
  Get("/api/status", [this](const httplib::Request&, httplib::Response& response) {
    response.set_content(status_json(board_.read()), json_type);
  });
  Get("/api/log",
      [this](const httplib::Request& request, httplib::Response& response) { send_log(request, response); });
  Get("/api/events",
      [this](const httplib::Request& request, httplib::Response& response) { send_events(request, response); });
  Post("/api/command",
       [this](const httplib::Request& request, httplib::Response& response) { take_command(request, response); });
}

void WebPages::serve(HttpStream& stream) {
  for (int i = 1; i <= max_requests_a_connection && stream.read_head(idle_time); ++i) {
    // A refused, unread body would be parsed as the next request.
    const bool is_last = i == max_requests_a_connection || stream.has_body();
    bool closed = false;
    if (!process_request(stream, is_last, closed, nullptr) || closed || is_last) {
      return;
    }
  }
}

WebPages::HandlerResponse WebPages::let_in(const httplib::Request& request, httplib::Response& response) {
  switch (guard_.judge(asker_of(request))) {
    case WebVerdict::welcome:
      return HandlerResponse::Unhandled;
    case WebVerdict::welcome_by_url:
      response.set_header("Set-Cookie", guard_.set_cookie());
      response.set_content(lead_on, html_type);
      response.status = 200;
      break;
    case WebVerdict::no_token:
      response.status = 401;
      response.set_content(std::string(no_token_text), "text/plain; charset=utf-8");
      break;
    case WebVerdict::wrong_site:
      response.status = 403;
      break;
    case WebVerdict::wrong_type:
      response.status = 415;
      break;
  }
  return HandlerResponse::Handled;
}

void WebPages::add_files() {
  for (const PageFile& file : page_files()) {
    const auto answer = [&file](const httplib::Request&, httplib::Response& response) {
      response.set_content(file.bytes.data(), file.bytes.size(), content_type_of(file.name));
    };
    Get(pattern_of(fmt::format("/{}", file.name)), answer);
    if (file.name == "index.html") {
      Get("/", answer);
    }
  }
}

void WebPages::take_command(const httplib::Request& request, httplib::Response& response) {
  bool allowed = false;
  {
    const std::lock_guard lock(rate_mutex_);
    allowed = command_rate_.allows(steady_clock::now());
  }
  if (!allowed) {
    response.status = 429;
    response.set_content(answer_json("too many commands at once; wait a moment, then send it again"), json_type);
    return;
  }
  try {
    TransportCommand command = parse_json_command(request.body, board_.read());
    command.source = "web " + request.remote_addr;
    commands_.push(std::move(command));
    response.set_content(answer_json(""), json_type);
  } catch (const Error& error) {
    response.status = 400;
    response.set_content(answer_json(error.what()), json_type);
  }
}

void WebPages::send_log(const httplib::Request& request, httplib::Response& response) const {
  try {
    response.set_content(log_json(log_->after(line_before(request))), json_type);
  } catch (const Error& error) {
    response.status = 400;
    response.set_content(answer_json(error.what()), json_type);
  }
}

void WebPages::send_events(const httplib::Request& request, httplib::Response& response) {
  std::atomic<int>& streams = asker_of(request).peer.is_loopback() ? local_streams_ : outside_streams_;
  if (streams.fetch_add(1) >= max_event_streams) {
    --streams;
    response.status = 503;
    return;
  }
  auto last_line = std::make_shared<std::uint64_t>(0);
  const auto provide = [this, last_line](std::size_t, httplib::DataSink& sink) {
    std::string events = fmt::format("event: status\ndata: {}\n\n", status_json(board_.read()));
    if (const std::vector<LogLine> lines = log_->after(*last_line); !lines.empty()) {
      *last_line = lines.back().number;
      events += fmt::format("event: log\ndata: {}\n\n", log_json(lines));
    }
    return sink.write(events.data(), events.size()) && !stop_.sleep_until(steady_clock::now() + event_interval);
  };
  response.set_chunked_content_provider("text/event-stream", provide, [&streams](bool) { --streams; });
}

}  // namespace ergodome
