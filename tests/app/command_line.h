#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <fstream>
#include <string>

#include "tests/support/folder_test.h"

namespace ergodome::test {

//! The program as a person runs it.
class CommandLine : public FolderTest {
 protected:
  //! Runs the program in the test's folder; all that it prints goes to output_.
  int run(const std::string& arguments) {
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

  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }

  std::string output_;
};

}  // namespace ergodome::test
