#pragma once

#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ergodome {

//! What may be asked of a running show: by keys, a pad, OSC, the page in a browser.
struct TransportCommand {
  enum class Kind {
    play,
    pause,
    toggle_pause,
    seek,     //!< value: show time [s]
    seek_by,  //!< value: seconds
    step,     //!< value: frames, back where negative; pauses
    speed,    //!< value: factor, backwards where negative
    chapter,  //!< value: index from 0
    next_chapter,
    previous_chapter,
    loop,      //!< value: 0 or 1
    blackout,  //!< value: 1 dark, 0 light; faded
    toggle_blackout,
    exposure,  //!< value: stops on top of the show's
    baseline,  //!< value: distance of the eyes [M]
    language,  //!< text: its tag
    next_language,
    captions,  //!< value: 0 or 1
    volume,    //!< value: factor, 0 to 1
    free_flight,
    return_to_path,
    reset,
    reload  //!< reads the show's file again
  };
  Kind kind = Kind::play;
  double value = 0.0;
  std::string text;
  std::string source{};  //!< who asked, for the log: "web 192.168.1.20"; empty: this program

  //! Whether two commands do the same, whoever asked for them.
  bool operator==(const TransportCommand& other) const {
    return kind == other.kind && value == other.value && text == other.text;
  }
};

//! Whether a command moves the show's time, which a clock from outside does alone.
constexpr bool moves_time(TransportCommand::Kind kind) {
  using Kind = TransportCommand::Kind;
  switch (kind) {
    case Kind::play:
    case Kind::pause:
    case Kind::toggle_pause:
    case Kind::seek:
    case Kind::seek_by:
    case Kind::step:
    case Kind::speed:
    case Kind::chapter:
    case Kind::next_chapter:
    case Kind::previous_chapter:
      return true;
    default:
      return false;
  }
}

//! Commands on their way from other threads to the player, in order. Bounded: a flood loses its oldest.
class CommandQueue {
 public:
  void push(TransportCommand command) {
    constexpr std::size_t most = 1024;
    const std::lock_guard lock(mutex_);
    if (commands_.size() >= most) {
      commands_.pop_front();
    }
    commands_.push_back(std::move(command));
  }

  [[nodiscard]] std::deque<TransportCommand> take_all() {
    const std::lock_guard lock(mutex_);
    return std::exchange(commands_, {});
  }

 private:
  std::mutex mutex_;
  std::deque<TransportCommand> commands_;
};

//! A controller as an operator sees it.
struct PadStatus {
  std::string name;
  std::string connection;  //!< "USB", "Bluetooth"
  bool active = false;     //!< moved within the last second
};

struct ChapterStatus {
  double time_s = 0.0;
  std::string title;                //!< in the language that is heard
  std::vector<std::string> titles;  //!< in all of the show's
};

//! What the player tells the world, once a frame.
struct PlayerStatus {
  std::string title;
  double time_s = 0.0;
  double duration_s = 0.0;
  bool playing = false;
  bool free_flight = false;
  double speed = 1.0;
  bool loop = true;
  bool blackout = false;
  double exposure_stops = 0.0;
  double baseline = 0.0;       //!< that is asked for [M]
  double baseline_used = 0.0;  //!< of the last picture: less, where more does not fit [M]
  bool stereo = false;
  double volume = 1.0;
  std::string language;
  std::vector<std::string> languages;
  bool captions = true;
  int chapter = -1;  //!< index of the one that is running
  std::vector<ChapterStatus> chapters;
  std::string clock;                //!< what the show's time follows, and how: "own", "MIDI time code"
  std::string follows;              //!< the clock from outside that moves its time alone; empty: none does
  std::string clock_state = "own";  //!< "own", "waiting", "following", "running_on" or "stopped"
  std::optional<double>
      clock_silence_s;   //!< since the clock from outside was last heard; nothing: never, or none is followed
  std::string sound;     //!< the audio device, or that there is none
  std::string observer;  //!< the mode of the camera's motion
  std::string lens;
  std::string backend;
  double frame_ms = 0.0;
  double worst_frame_ms = 0.0;  //!< of the last ten seconds
  long frames = 0;
  long dropped_frames = 0;
  std::vector<PadStatus> pads;
  std::string problem;  //!< what went wrong last; empty: all is well
};

//! The latest status, for threads that show it.
class StatusBoard {
 public:
  void post(PlayerStatus status) {
    const std::lock_guard lock(mutex_);
    status_ = std::move(status);
  }

  [[nodiscard]] PlayerStatus read() const {
    const std::lock_guard lock(mutex_);
    return status_;
  }

 private:
  mutable std::mutex mutex_;
  PlayerStatus status_;
};

}  // namespace ergodome
