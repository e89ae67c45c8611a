#include "app/commands/farm/programs.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "kernels/core/error.h"

extern char** environ;  // NOLINT: POSIX's name

namespace ergodome {

namespace {

//! What a started program inherits.
class SpawnSettings {
 public:
  SpawnSettings() {
    posix_spawn_file_actions_init(&actions_);
    posix_spawnattr_init(&attributes_);
    posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  }
  ~SpawnSettings() {
    posix_spawn_file_actions_destroy(&actions_);
    posix_spawnattr_destroy(&attributes_);
  }
  SpawnSettings(const SpawnSettings&) = delete;
  SpawnSettings& operator=(const SpawnSettings&) = delete;

  void send_output_to(int handle) {
    posix_spawn_file_actions_adddup2(&actions_, handle, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions_, handle, STDERR_FILENO);
  }
  void drop_output() {
    posix_spawn_file_actions_addopen(&actions_, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&actions_, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  }
  void use_own_group() {
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETPGROUP);
    posix_spawnattr_setpgroup(&attributes_, 0);
  }

  pid_t start(const std::vector<std::string>& words, const std::string& remedy) {
    std::vector<char*> arguments;
    arguments.reserve(words.size() + 1);
    for (const std::string& word : words) {
      arguments.push_back(const_cast<char*>(word.c_str()));
    }
    arguments.push_back(nullptr);
    pid_t process = 0;
    const int problem =
        posix_spawnp(&process, words.front().c_str(), &actions_, &attributes_, arguments.data(), environ);
    if (problem != 0) {
      throw Error(words.front(), std::string("cannot be started: ") + std::strerror(problem), remedy);
    }
    return process;
  }

 private:
  posix_spawn_file_actions_t actions_;
  posix_spawnattr_t attributes_;
};

}  // namespace

int exit_status(int wait_status) {
  return WIFEXITED(wait_status) ? WEXITSTATUS(wait_status) : 128 + WTERMSIG(wait_status);
}

ProgramResult run_and_read(const std::vector<std::string>& words, const std::string& remedy) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) {
    throw Error(words.front(), std::string("cannot be started: ") + std::strerror(errno),
                "close other programs and try again");
  }
  pid_t process = 0;
  try {
    SpawnSettings settings;
    settings.send_output_to(ends[1]);
    process = settings.start(words, remedy);
  } catch (const Error&) {
    ::close(ends[0]);
    ::close(ends[1]);
    throw;
  }
  ::close(ends[1]);
  ProgramResult result;
  char buffer[4096];
  for (ssize_t got = 0; (got = ::read(ends[0], buffer, sizeof buffer)) > 0 || (got < 0 && errno == EINTR);) {
    result.output.append(buffer, static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
  }
  ::close(ends[0]);
  int status = 0;
  while (::waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  result.status = exit_status(status);
  return result;
}

pid_t start_program(const std::vector<std::string>& words) {
  SpawnSettings settings;
  settings.drop_output();
  settings.use_own_group();
  return settings.start(words, "check the installation of " + words.front());
}

}  // namespace ergodome
