// Lets the server named by the environment variable ERGODOME_READY run this command line, and exits
// with the status of that run. Exits with 125 if the server does not exist.
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "tests/app/ready/call.h"

int main(int argc, char** argv) {
  using namespace ergodome::test;
  Call call = {std::filesystem::current_path().string(), {argv, argv + argc}, {}, {0, 1, 2}};
  for (char** variable = environ; *variable != nullptr; ++variable) {
    call.environment.emplace_back(*variable);
  }
  const char* const name = std::getenv("ERGODOME_READY");
  const int socket = connect_to(name != nullptr ? name : "");
  if (socket < 0 || !send_call(socket, call)) {
    std::fputs("call_ergodome: no server\n", stderr);
    return 125;
  }
  return receive_status(socket).value_or(125);
}
