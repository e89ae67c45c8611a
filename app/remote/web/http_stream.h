#pragma once

#include <httplib.h>

#include <string>
#include <string_view>

#include "app/remote/common/net_address.h"
#include "app/remote/common/stop_signal.h"

namespace ergodome {

//! A connection for httplib, with the limits that httplib lacks: the head of a request is read
//! completely, within a size and a time, before httplib sees it; a client that does not read for a
//! while is disconnected; and everything ends with the stop signal.
class HttpStream : public httplib::Stream {
 public:
  static constexpr std::size_t max_head_bytes = 8192;
  static constexpr std::size_t max_head_lines = 64;
  static constexpr std::chrono::milliseconds head_time{3000};
  static constexpr std::chrono::milliseconds body_time{2000};
  static constexpr std::chrono::milliseconds write_time{2000};

  //! The socket must be non-blocking.
  HttpStream(Descriptor socket, const NetAddress& peer, const StopSignal& stop)
      : socket_(std::move(socket)), peer_(peer), stop_(stop) {}

  enum class Head { incomplete, complete, failed };

  //! Reads the available part of the first request's head, without waiting.
  Head poll_head();
  //! Returns the head that poll_head() found complete, as it was sent.
  [[nodiscard]] std::string_view head() const;
  //! Sends a short answer without waiting, and ends the connection.
  void refuse(std::string_view answer);
  void close() { socket_.reset(); }

  //! Waits up to `idle_time` for the next request and reads its head, without headers that the page
  //! does not need. Returns false if none comes, or if its head is too long, too slow or malformed.
  bool read_head(std::chrono::milliseconds idle_time);

  //! Returns whether a body follows, according to the last head.
  [[nodiscard]] bool has_body() const { return has_body_; }
  [[nodiscard]] const NetAddress& peer() const { return peer_; }

  [[nodiscard]] bool is_readable() const override;
  [[nodiscard]] bool is_writable() const override;
  ssize_t read(char* data, std::size_t size) override;
  ssize_t write(const char* data, std::size_t size) override;
  void get_remote_ip_and_port(std::string& host, int& port) const override;
  void get_local_ip_and_port(std::string& host, int& port) const override;
  [[nodiscard]] socket_t socket() const override { return socket_.get(); }

 private:
  using Instant = std::chrono::steady_clock::time_point;

  bool receive(Instant deadline);
  [[nodiscard]] bool is_read_up() const { return position_ >= buffer_.size(); }
  bool keep_plain_lines(std::size_t end);

  Descriptor socket_;
  NetAddress peer_;
  const StopSignal& stop_;
  std::string buffer_;        // received bytes
  std::size_t position_ = 0;  // position in buffer_ up to which httplib has read
  Instant body_deadline_;
  bool has_body_ = false;
};

}  // namespace ergodome
