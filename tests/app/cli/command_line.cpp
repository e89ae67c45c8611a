#include "tests/app/cli/command_line.h"

#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <random>

#include "tests/support/child_process.h"

namespace ergodome::test {

namespace {

//! Runs the server `ergodome_ready` until the end of the tests. It keeps the program loaded, so
//! that each command line of a test starts quickly.
class ReadyProgram {
 public:
  ReadyProgram() : process_({ERGODOME_READY_PROGRAM, name_}) {
    EXPECT_NE(process_.output_until("ready", std::chrono::minutes(1)).find("ready"), std::string::npos);
  }

  //! Returns the start of a shell command line that runs the program through this server.
  [[nodiscard]] std::string called() const { return "ERGODOME_READY=" + name_ + " '" ERGODOME_CALL_PROGRAM "' "; }

 private:
  std::string name_ = "ergodome-tests-" + std::to_string(::getpid()) + "-" + std::to_string(std::random_device{}());
  ChildProcess process_;
};

}  // namespace

void CommandLine::SetUp() {
  FolderTest::SetUp();
  std::string sky = "P3 64 32 255\n";
  unsigned value = 1;
  for (int i = 0; i < 3 * 64 * 32; ++i) {
    value = value * 1664525U + 1013904223U;
    sky += std::to_string(value >> 24U) + "\n";
  }
  write("sky.ppm", sky);
}

int CommandLine::run(const std::string& arguments) {
  static const ReadyProgram program;
  return run_command("cd '" + folder_.string() + "' && " + program.called() + arguments + " 2>&1");
}

int CommandLine::run_with_driver(const std::string& arguments) {
  return run_command("cd '" + folder_.string() +
                     "' && ASAN_OPTIONS=$ASAN_OPTIONS:detect_leaks=0 '" ERGODOME_PROGRAM "' " + arguments + " 2>&1");
}

bool CommandLine::has_display() { return std::system("command -v xvfb-run >/dev/null") == 0; }

int CommandLine::run_on_display(const std::string& arguments, const std::string& environment) {
  // The leak checker is off: OpenGL drivers leak memory, and they are unloaded before the leak
  // checker could attribute the leaks to them.
  return run_command("cd '" + folder_.string() + "' && ASAN_OPTIONS=$ASAN_OPTIONS:detect_leaks=0 " + environment +
                     " xvfb-run -a -s '-screen 0 800x600x24' '" ERGODOME_PROGRAM "' " + arguments + " 2>&1");
}

int CommandLine::run_command(const std::string& command) {
  FILE* pipe = ::popen(command.c_str(), "r");
  output_.clear();
  char buffer[4096];
  for (std::size_t got = 0; (got = std::fread(buffer, 1, sizeof buffer, pipe)) > 0;) {
    output_.append(buffer, got);
  }
  const int status = ::pclose(pipe);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace ergodome::test
