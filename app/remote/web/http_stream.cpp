#include "app/remote/web/http_stream.h"

#include <poll.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <string_view>

namespace ergodome {

namespace {

using std::chrono::steady_clock;

constexpr std::string_view head_end = "\r\n\r\n";

bool is_header(std::string_view line, std::string_view name) {
  return line.size() > name.size() && line[name.size()] == ':' &&
         std::equal(name.begin(), name.end(), line.begin(),
                    [](char a, char b) { return a == (b >= 'A' && b <= 'Z' ? static_cast<char>(b - 'A' + 'a') : b); });
}

//! Returns whether to drop a header that the page does not need: ranges and compression turn short
//! requests into much work.
bool is_left_out(std::string_view line) {
  return is_header(line, "range") || is_header(line, "accept-encoding") || is_header(line, "expect");
}

}  // namespace

bool HttpStream::receive(Instant deadline) {
  std::array<char, 4096> part;
  while (true) {
    const ssize_t size = ::recv(socket_.get(), part.data(), part.size(), 0);
    if (size > 0) {
      buffer_.append(part.data(), static_cast<std::size_t>(size));
      return true;
    }
    if (size == 0 || (errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR)) {
      return false;
    }
    if (stop_.wait(socket_.get(), POLLIN, deadline) != StopSignal::Wake::ready) {
      return false;
    }
  }
}

HttpStream::Head HttpStream::poll_head() {
  std::array<char, 4096> part;
  while (buffer_.find(head_end) == std::string::npos) {
    const ssize_t size = ::recv(socket_.get(), part.data(), part.size(), MSG_DONTWAIT);
    if (size < 0 && errno == EINTR) {
      continue;
    }
    if (size <= 0) {
      const bool more = size < 0 && (errno == EAGAIN || errno == EWOULDBLOCK);
      return more ? Head::incomplete : Head::failed;
    }
    buffer_.append(part.data(), static_cast<std::size_t>(size));
    if (buffer_.size() > max_head_bytes + part.size()) {
      return Head::failed;
    }
  }
  return Head::complete;
}

std::string_view HttpStream::head() const {
  const std::size_t end = buffer_.find(head_end);
  return end == std::string::npos ? std::string_view() : std::string_view(buffer_).substr(0, end + head_end.size());
}

void HttpStream::refuse(std::string_view answer) {
  static_cast<void>(::send(socket_.get(), answer.data(), answer.size(), MSG_DONTWAIT | MSG_NOSIGNAL));
  ::shutdown(socket_.get(), SHUT_WR);
  // Unread bytes would make the system reset the connection and cut off the answer.
  std::array<char, 4096> rest;
  for (int i = 0; i < 4 && ::recv(socket_.get(), rest.data(), rest.size(), MSG_DONTWAIT) > 0; ++i) {
  }
  close();
}

bool HttpStream::read_head(std::chrono::milliseconds idle_time) {
  buffer_.erase(0, position_);
  position_ = 0;
  if (buffer_.empty() && !receive(steady_clock::now() + idle_time)) {
    return false;
  }
  const Instant deadline = steady_clock::now() + head_time;
  std::size_t end = buffer_.find(head_end);
  while (end == std::string::npos) {
    if (buffer_.size() > max_head_bytes || !receive(deadline)) {
      return false;
    }
    end = buffer_.find(head_end);
  }
  body_deadline_ = steady_clock::now() + body_time;
  return end <= max_head_bytes && keep_plain_lines(end + head_end.size());
}

bool HttpStream::keep_plain_lines(std::size_t end) {
  std::string head;
  std::string_view rest = std::string_view(buffer_).substr(0, end);
  has_body_ = false;
  for (std::size_t lines = 0; !rest.empty(); ++lines) {
    const std::size_t length = rest.find("\r\n") + 2;
    const std::string_view line = rest.substr(0, length);
    // Rejects bodies without a length, which are not needed. Like malformed line ends, they could
    // make two parsers interpret a request differently.
    const bool odd = line.find_first_of(std::string_view("\r\n\0", 3)) != length - 2;
    if (lines > max_head_lines || odd || is_header(line, "transfer-encoding")) {
      return false;
    }
    has_body_ = has_body_ || is_header(line, "content-length");
    if (!is_left_out(line)) {
      head += line;
    }
    rest.remove_prefix(length);
  }
  buffer_.replace(0, end, head);
  return true;
}

bool HttpStream::is_readable() const {
  return !is_read_up() || stop_.wait(socket_.get(), POLLIN, body_deadline_) == StopSignal::Wake::ready;
}

bool HttpStream::is_writable() const {
  return stop_.wait(socket_.get(), POLLOUT, steady_clock::now() + write_time) == StopSignal::Wake::ready;
}

ssize_t HttpStream::read(char* data, std::size_t size) {
  if (is_read_up()) {
    buffer_.clear();
    position_ = 0;
    if (!receive(body_deadline_)) {
      return -1;
    }
  }
  const std::size_t taken = std::min(size, buffer_.size() - position_);
  std::memcpy(data, buffer_.data() + position_, taken);
  position_ += taken;
  return static_cast<ssize_t>(taken);
}

ssize_t HttpStream::write(const char* data, std::size_t size) {
  const Instant deadline = steady_clock::now() + write_time;
  std::size_t sent = 0;
  while (sent < size) {
    const ssize_t part = ::send(socket_.get(), data + sent, size - sent, MSG_NOSIGNAL);
    if (part > 0) {
      sent += static_cast<std::size_t>(part);
    } else if (errno != EINTR && ((errno != EAGAIN && errno != EWOULDBLOCK) ||
                                  stop_.wait(socket_.get(), POLLOUT, deadline) != StopSignal::Wake::ready)) {
      return -1;
    }
  }
  return static_cast<ssize_t>(size);
}

void HttpStream::get_remote_ip_and_port(std::string& host, int& port) const {
  host = peer_.host();
  port = peer_.port();
}

void HttpStream::get_local_ip_and_port(std::string& host, int& port) const {
  const NetAddress local = local_address(socket_.get());
  host = local.host();
  port = local.port();
}

}  // namespace ergodome
