#pragma once

#include <map>
#include <mutex>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace ergodome {

//! Sentences for the log from where shows are loaded, in whatever thread: each is told once, however often a show is read again, and anew where it had
//! gone and comes again.
class NoteBoard {
 public:
  //! All that there is to tell of a show as it was loaded now, in place of what there was before.
  void post(const std::string& show, const std::vector<std::string>& notes) {
    const std::lock_guard lock(mutex_);
    for (const std::string& note : notes) {
      if (!stands(note)) {
        waiting_.push_back(note);
        standing_[show].insert(note);
      }
    }
    standing_[show] = {notes.begin(), notes.end()};
  }

  //! Those since the last call.
  std::vector<std::string> take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(waiting_, {});
  }

 private:
  //! Shows of an exhibit may have the same to tell.
  [[nodiscard]] bool stands(const std::string& note) const {
    for (const auto& [show, notes] : standing_) {
      if (notes.contains(note)) {
        return true;
      }
    }
    return false;
  }

  std::mutex mutex_;
  std::map<std::string, std::set<std::string>> standing_;  //!< by the shows' names
  std::vector<std::string> waiting_;
};

}  // namespace ergodome
