#pragma once

#include <fcntl.h>
#include <sched.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <functional>
#include <future>
#include <string>
#include <thread>

// Simulates several hosts on a network, by network namespaces of Linux.
namespace ergodome::test {

//! Moves this thread, and the threads that it starts later, into a network namespace that has only
//! a loopback interface. Returns false if the system does not allow that.
inline bool enter_own_network() {
  const auto user = ::geteuid();
  if (user != 0 && ::unshare(CLONE_NEWUSER) == 0) {
    std::ofstream("/proc/self/uid_map") << "0 " << user << " 1";
  }
  return ::unshare(CLONE_NEWNET) == 0 && std::system("ip link set lo up 2>/dev/null") == 0;
}

//! Another host on the network of the test: a thread in its own network namespace. A virtual cable
//! connects it with the namespace of the test. On this cable, the test has the address 10.213.N.1
//! and the host 10.213.N.2.
class NetworkHost {
 public:
  explicit NetworkHost(int number) : number_(number) {}
  ~NetworkHost() {
    if (thread_.joinable()) {
      thread_.join();
    }
  }
  NetworkHost(const NetworkHost&) = delete;
  NetworkHost& operator=(const NetworkHost&) = delete;

  [[nodiscard]] std::string address_of_test() const { return "10.213." + std::to_string(number_) + ".1"; }

  //! Creates the host and runs `work` on it. Returns false if the host cannot be created.
  bool run(std::function<void()> work) {
    std::promise<long> id;
    std::promise<void> cable;
    thread_ = std::thread([&id, connected = cable.get_future(), work = std::move(work)]() mutable {
      const bool own = ::unshare(CLONE_NEWNET) == 0;
      id.set_value(own ? ::syscall(SYS_gettid) : -1);
      connected.wait();
      if (own) {
        work();
      }
    });
    const long host = id.get_future().get();
    const bool connected = host > 0 && connect(std::to_string(host));
    cable.set_value();
    return connected;
  }

 private:
  [[nodiscard]] bool connect(const std::string& host) const {
    const std::string number = std::to_string(number_);
    const std::string net = "10.213." + number;
    const std::string inside = "nsenter --net=/proc/" + host + "/ns/net ip ";
    const std::string commands = "exec 2>/dev/null; ip link add e" + number + " type veth peer name h" + number +
                                 " && ip link set h" + number + " netns " + host + " && ip address add " + net +
                                 ".1/24 dev e" + number + " && ip link set e" + number + " up && " + inside +
                                 "address add " + net + ".2/24 dev h" + number + " && " + inside + "link set h" +
                                 number + " up";
    return std::system(commands.c_str()) == 0;
  }

  int number_;
  std::thread thread_;
};

}  // namespace ergodome::test
