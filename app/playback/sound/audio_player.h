#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "app/playback/sound/audio_mixer.h"

namespace ergodome {

//! Plays a show's sound on the machine's device, on a separate thread.
//!
//! Without a device, or when it is unplugged, the show continues without sound, which is reported
//! once; the player retries every few seconds.
class AudioPlayer {
 public:
  explicit AudioPlayer(double later_s = 0.0);
  ~AudioPlayer();
  AudioPlayer(const AudioPlayer&) = delete;
  AudioPlayer& operator=(const AudioPlayer&) = delete;

  //! Replaces the soundtrack by that of another show, or another version of the show.
  void set_soundtrack(Soundtrack soundtrack);
  //! Sets the state of the show; called once per frame. Returns at once.
  void follow(const AudioCue& cue);

  //! Returns messages about problems since the last call, each once.
  std::vector<std::string> take_problems();
  //! Returns the latest problem of this show's sound; empty if there is none.
  [[nodiscard]] std::string problem() const;
  //! Returns the name of the device, or that there is none, for the status.
  [[nodiscard]] std::string state() const;

 private:
  void run();
  void find_output();
  void mix(const AudioCue& cue);
  void take_over(Soundtrack soundtrack);
  void say(std::string problem);
  void unsay(const std::string& problem);
  void set_state(std::string state);
  void check_files();

  double later_s_;
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  bool ends_ = false;
  std::optional<Soundtrack> new_soundtrack_;
  std::optional<AudioCue> cue_;
  std::vector<std::string> problems_;
  std::string problem_;
  std::string state_ = "no sound yet";

  // The following members are used only by the thread.
  Soundtrack soundtrack_;
  std::unique_ptr<AudioOutput> output_;
  std::unique_ptr<AudioMixer> mixer_;
  std::optional<MonotonicTime> checked_;
  bool reported_silent_ = false;
  //! Whether the files of this soundtrack were checked, without a device to play them.
  bool checked_files_ = false;
  //! Problems of files already reported, so that each is reported once.
  std::set<std::string> reported_files_;
  std::thread thread_;
};

}  // namespace ergodome
