#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace ergodome {

//! Collects notes for the log from loading shows, in any thread. Reports each once, however often a
//! show is read again, and again if it had disappeared and returns.
class NoteBoard {
 public:
  //! The notes of one reading of a show. Threads that continue to read may keep it and add to it.
  using Reading = std::shared_ptr<std::set<std::string>>;

  void add(const Reading& reading, const std::string& note) {
    const std::lock_guard lock(mutex_);
    if (!reading->contains(note) && !stands(note)) {
      waiting_.push_back(note);
    }
    reading->insert(note);
  }

  //! Replaces the notes of a show with those of a newer reading.
  void supersede(const std::string& show, Reading reading) {
    const std::lock_guard lock(mutex_);
    standing_[show] = std::move(reading);
  }

  //! Replaces the notes of a show with `notes`.
  void post(const std::string& show, const std::vector<std::string>& notes) {
    auto reading = std::make_shared<std::set<std::string>>();
    for (const std::string& note : notes) {
      add(reading, note);
    }
    supersede(show, std::move(reading));
  }

  //! Returns the notes since the last call.
  std::vector<std::string> take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(waiting_, {});
  }

 private:
  //! Returns whether any show has this note: several shows of an exhibit may have the same one.
  [[nodiscard]] bool stands(const std::string& note) const {
    for (const auto& [show, notes] : standing_) {
      if (notes->contains(note)) {
        return true;
      }
    }
    return false;
  }

  std::mutex mutex_;
  std::map<std::string, Reading> standing_;  //!< notes of the latest readings, by the name of the show
  std::vector<std::string> waiting_;
};

}  // namespace ergodome
