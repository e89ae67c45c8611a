#include "tests/app/command_line.h"

#include <sys/wait.h>

#include <cstdio>

namespace ergodome::test {

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
  const std::string command = "cd '" + folder_.string() + "' && '" ERGODOME_PROGRAM "' " + arguments + " 2>&1";
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
