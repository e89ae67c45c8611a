#pragma once

#include <mutex>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace ergodome {

//! Sentences for the log from where shows are loaded, in whatever thread: each is told once, however often a show is read again.
class NoteBoard {
 public:
  void post(const std::string& note) {
    const std::lock_guard lock(mutex_);
    if (posted_.insert(note).second) {
      waiting_.push_back(note);
    }
  }

  //! Those since the last call.
  std::vector<std::string> take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(waiting_, {});
  }

 private:
  std::mutex mutex_;
  std::set<std::string> posted_;
  std::vector<std::string> waiting_;
};

}  // namespace ergodome
