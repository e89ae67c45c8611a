#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

// The protocol between the server `ergodome_ready`, which keeps the program loaded, and its
// clients, which have command lines for it.
namespace ergodome::test {

//! A command line that the server runs in place of the client process.
struct Call {
  std::string folder;              //!< working directory
  std::vector<std::string> words;  //!< starts with the program's name
  //! Environment variables, each as NAME=VALUE.
  std::vector<std::string> environment;
  //! File descriptors of standard input, output and error.
  std::array<int, 3> streams{};
};

//! connect_to() returns a client socket, listen_as() a listening socket, for the abstract address
//! `name`; -1 on failure.
int connect_to(const std::string& name);
int listen_as(const std::string& name);

//! Sends a call to the server; returns false if the server has closed the connection.
bool send_call(int socket, const Call& call);
//! Receives a call. Its `streams` are open file descriptors of this process. Returns nothing if the
//! data is not a call.
std::optional<Call> receive_call(int socket);

bool send_status(int socket, int status);
std::optional<int> receive_status(int socket);

}  // namespace ergodome::test
