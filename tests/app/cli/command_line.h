#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "tests/support/folder_test.h"

namespace ergodome::test {

//! Runs the program as a user would, in a temporary folder.
class CommandLine : public FolderTest {
 protected:
  //! Writes sky.ppm, a sky map of a few pixels, to the test's folder. Loading the built-in maps
  //! takes longer than rendering most pictures of a test.
  void SetUp() override;

  //! Runs the program in the test's folder, in a new process; output_ receives everything that it
  //! prints. Returns the exit status.
  int run(const std::string& arguments);

  //! Runs the program with the leak checker off, for commands that load an OpenGL driver, because
  //! drivers leak memory. Starts the program in a new process, not through the server of
  //! ReadyProgram.
  int run_with_driver(const std::string& arguments);

  //! Runs the program on a new virtual display. `environment` contains assignments NAME=VALUE,
  //! which are written before the program on the command line.
  int run_on_display(const std::string& arguments, const std::string& environment);
  //! Returns whether a virtual display can be created.
  static bool has_display();

  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }

  std::string output_;

 private:
  int run_command(const std::string& command);
};

}  // namespace ergodome::test
