#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "tests/support/folder_test.h"

namespace ergodome::test {

//! The program as a person runs it.
class CommandLine : public FolderTest {
 protected:
  //! Puts a sky of few pixels into the folder, sky.ppm: to load the built-in ones takes longer than
  //! most pictures of a test.
  void SetUp() override;

  //! Runs the program in the test's folder, in a process of its own; all that it prints goes to
  //! output_.
  int run(const std::string& arguments);

  //! The same for what loads an OpenGL driver: such keep memory, and the leak checker is off.
  //! Starts the program itself.
  int run_with_driver(const std::string& arguments);

  //! The same on a virtual display of its own; `environment` stands before the program.
  int run_on_display(const std::string& arguments, const std::string& environment);
  //! Whether there is anything to make one with.
  static bool has_display();

  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }

  std::string output_;

 private:
  int run_command(const std::string& command);
};

}  // namespace ergodome::test
