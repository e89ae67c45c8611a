#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace ergodome::test {

//! A command line that another process shall run in place of the one that was started.
struct Call {
  std::string folder;                    //!< where
  std::vector<std::string> words;        //!< the program's name first
  std::vector<std::string> environment;  //!< NAME=VALUE
  std::array<int, 3> streams{};          //!< standard input, output and error
};

//! A socket to, or of, the server of that name, for which no file stands; -1 where it is not there
//! or cannot be.
int connect_to(const std::string& name);
int listen_as(const std::string& name);

//! False where the other end is gone.
bool send_call(int socket, const Call& call);
//! With streams of its own; nothing where what comes is no call.
std::optional<Call> receive_call(int socket);

bool send_status(int socket, int status);
std::optional<int> receive_status(int socket);

}  // namespace ergodome::test
