#pragma once

#include <sys/types.h>

#include <chrono>
#include <string>
#include <vector>

#include "app/remote/descriptor.h"

namespace ergodome::test {

//! A program that runs beside the test, in a process group that ends with this object.
class ChildProcess {
 public:
  //! Looks the program up in PATH; its output comes back through a pipe.
  explicit ChildProcess(const std::vector<std::string>& command);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  //! What it has written until a text appeared in it, it ended, or the time was over.
  std::string output_until(const std::string& text, std::chrono::milliseconds most);

 private:
  pid_t process_ = -1;
  Descriptor output_;
};

}  // namespace ergodome::test
