#include "app/player/recording_file.h"

#include "content/files/atomic_file.h"
#include "content/show_reader.h"

namespace ergodome {

namespace {

constexpr std::chrono::seconds interval{10};

}  // namespace

void RecordingFile::keep(const PlayerSession& session) {
  if (wanted() && Clock::now() - saved_ > interval) {
    save(session);
  }
}

void RecordingFile::save(const PlayerSession& session) {
  saved_ = Clock::now();
  if (const auto flight = wanted() ? session.recorded("Recorded flight") : std::nullopt) {
    write_text_atomically(path_, to_toml(*flight));
  }
}

}  // namespace ergodome
