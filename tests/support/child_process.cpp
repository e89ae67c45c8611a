#include "tests/support/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>

namespace ergodome::test {

ChildProcess::ChildProcess(const std::vector<std::string>& command) {
  std::array<int, 2> ends = {-1, -1};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
    return;
  }
  output_ = Descriptor(ends[0]);
  Descriptor input(ends[1]);
  std::vector<char*> arguments;
  arguments.reserve(command.size() + 1);
  for (const std::string& word : command) {
    arguments.push_back(const_cast<char*>(word.c_str()));
  }
  arguments.push_back(nullptr);
  process_ = ::fork();
  if (process_ == 0) {
    ::setpgid(0, 0);
    ::dup2(ends[1], STDOUT_FILENO);
    ::dup2(ends[1], STDERR_FILENO);
    ::execvp(arguments[0], arguments.data());
    ::_exit(127);
  }
}

ChildProcess::~ChildProcess() {
  if (process_ > 0) {
    ::kill(-process_, SIGKILL);
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
  }
}

std::string ChildProcess::output_until(const std::string& text, std::chrono::milliseconds maximum) {
  std::string output;
  const auto deadline = std::chrono::steady_clock::now() + maximum;
  while (output.find(text) == std::string::npos && std::chrono::steady_clock::now() < deadline) {
    pollfd polled = {output_.get(), POLLIN, 0};
    if (::poll(&polled, 1, 100) <= 0) {
      continue;
    }
    std::array<char, 1024> part = {};
    const ssize_t size = ::read(output_.get(), part.data(), part.size());
    if (size <= 0) {
      break;
    }
    output.append(part.data(), static_cast<std::size_t>(size));
  }
  return output;
}

}  // namespace ergodome::test
