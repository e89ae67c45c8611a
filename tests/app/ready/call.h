#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

// The protocol between a process that waits with the loaded program and those that call it.
namespace ergodome::test {

//! A command line that another process runs in place of this one.
struct Call {
  std::string folder;                    //!< working directory
  std::vector<std::string> words;        //!< starts with the program's name
  std::vector<std::string> environment;  //!< NAME=VALUE
  std::array<int, 3> streams{};          //!< standard input, output and error
};

//! Returns a client or a listening socket for the abstract address `name`; -1 on failure.
int connect_to(const std::string& name);
int listen_as(const std::string& name);

//! Sends a call; returns false if the other end is closed.
bool send_call(int socket, const Call& call);
//! Receives a call, with open streams. Returns nothing if the data is not a call.
std::optional<Call> receive_call(int socket);

bool send_status(int socket, int status);
std::optional<int> receive_status(int socket);

}  // namespace ergodome::test
