#pragma once

#include <sys/types.h>

#include <chrono>
#include <string>
#include <vector>

#include "app/remote/common/net_address.h"

namespace ergodome::test {

//! A program that runs while the test continues. The destructor kills its process group.
class ChildProcess {
 public:
  //! Starts a program, which is found in PATH. Its output is read through a pipe.
  explicit ChildProcess(const std::vector<std::string>& command);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  //! Waits until `text` has appeared in the output, the program has ended or the time has run out.
  //! Returns the output up to then.
  std::string output_until(const std::string& text, std::chrono::milliseconds maximum);

 private:
  pid_t process_ = -1;
  Descriptor output_;
};

}  // namespace ergodome::test
