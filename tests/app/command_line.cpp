#include "tests/app/command_line.h"

#include <sys/wait.h>

#include <cstdio>

namespace ergodome::test {

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
