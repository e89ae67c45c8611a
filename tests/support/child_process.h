#pragma once

#include <sys/types.h>

#include <chrono>
#include <string>
#include <vector>

#include "app/remote/common/net_address.h"

namespace ergodome::test {

//! A program that runs in parallel with the test; its process group is killed by the destructor.
class ChildProcess {
 public:
  //! Starts the program, found in PATH; a pipe carries its output back.
  explicit ChildProcess(const std::vector<std::string>& command);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  //! Returns the output once `text` has appeared in it, the program has ended or the time has run
  //! out.
  std::string output_until(const std::string& text, std::chrono::milliseconds most);

 private:
  pid_t process_ = -1;
  Descriptor output_;
};

}  // namespace ergodome::test
