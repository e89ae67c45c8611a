#pragma once

#include <map>
#include <memory>
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
  //! What there is to tell of a show as it was read once. Threads that go on reading may keep it and add to it.
  using Reading = std::shared_ptr<std::set<std::string>>;

  void add(const Reading& reading, const std::string& note) {
    const std::lock_guard lock(mutex_);
    if (!reading->contains(note) && !stands(note)) {
      waiting_.push_back(note);
    }
    reading->insert(note);
  }

  //! A show has been read: what there was to tell of it before stands no more.
  void take_place(const std::string& show, Reading reading) {
    const std::lock_guard lock(mutex_);
    standing_[show] = std::move(reading);
  }

  //! All that there is to tell of a show as it was loaded now, in place of what there was before.
  void post(const std::string& show, const std::vector<std::string>& notes) {
    auto reading = std::make_shared<std::set<std::string>>();
    for (const std::string& note : notes) {
      add(reading, note);
    }
    take_place(show, std::move(reading));
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
      if (notes->contains(note)) {
        return true;
      }
    }
    return false;
  }

  std::mutex mutex_;
  std::map<std::string, Reading> standing_;  //!< by the shows' names
  std::vector<std::string> waiting_;
};

}  // namespace ergodome
