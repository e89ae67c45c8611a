// The program with OpenImageIO loaded, as a server: it waits for command lines and runs each in a
// forked process. Loading the hundreds of libraries of OpenImageIO takes half a second of CPU time,
// and the tests start the program about five hundred times.
//
// ergodome_ready NAME
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <optional>
#include <vector>

#include "app/cli/commands.h"
#include "content/images/image_library.h"
#include "tests/app/ready/call.h"

namespace ergodome::test {

namespace {

constexpr int no_program = 125;  //!< exit status if the program could not be run

//! Makes the kernel kill this process when its parent ends, so that killed tests leave no processes
//! behind.
void end_with_parent() { ::prctl(PR_SET_PDEATHSIG, SIGKILL); }

//! Ends a forked process. Skips exit handlers, which would wait for threads of loaded libraries.
//! These threads do not exist after a fork.
[[noreturn]] void end(int status) {
  std::cout.flush();
  std::fflush(nullptr);
  ::_exit(status);
}

[[noreturn]] void run(Call& call) {
  for (int stream = 0; stream < 3; ++stream) {
    ::dup2(call.streams[static_cast<std::size_t>(stream)], stream);
    ::close(call.streams[static_cast<std::size_t>(stream)]);
  }
  std::signal(SIGCHLD, SIG_DFL);
  ::clearenv();
  for (std::string& variable : call.environment) {
    ::putenv(variable.data());
  }
  if (::chdir(call.folder.c_str()) != 0) {
    end(no_program);
  }
  std::vector<char*> words;
  words.reserve(call.words.size() + 1);
  for (std::string& word : call.words) {
    words.push_back(word.data());
  }
  words.push_back(nullptr);
  end(run_program(static_cast<int>(call.words.size()), words.data()));
}

//! Receives a call from the socket, runs it in a new process, and sends back its exit status.
void serve(int socket) {
  std::optional<Call> call = receive_call(socket);
  if (!call) {
    return;
  }
  std::signal(SIGCHLD, SIG_DFL);
  const pid_t worker = ::fork();
  if (worker == 0) {
    end_with_parent();
    ::close(socket);
    run(*call);
  }
  int status = 0;
  while (worker > 0 && ::waitpid(worker, &status, 0) < 0 && errno == EINTR) {
  }
  send_status(socket, worker < 0 ? no_program : WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status));
}

int wait_for_calls(const char* name) {
  end_with_parent();
  std::signal(SIGCHLD, SIG_IGN);
  const int listening = listen_as(name);
  if (listening < 0) {
    std::perror(name);
    return 1;
  }
  static_cast<void>(image_library());
  std::puts("ready");
  std::fflush(stdout);
  while (true) {
    const int socket = ::accept4(listening, nullptr, nullptr, SOCK_CLOEXEC);
    if (socket < 0 && errno != EINTR && errno != ECONNABORTED) {
      std::perror(name);
      return 1;
    }
    if (socket < 0) {
      continue;
    }
    if (::fork() == 0) {
      end_with_parent();
      ::close(listening);
      serve(socket);
      ::_exit(0);
    }
    ::close(socket);
  }
}

}  // namespace

}  // namespace ergodome::test

int main(int argc, char** argv) { return argc == 2 ? ergodome::test::wait_for_calls(argv[1]) : 2; }
