#pragma once

#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ergodome {

//! A command for a running show, from keys, a controller, OSC or the status page.
struct TransportCommand {
  enum class Kind {
    play,
    pause,
    toggle_pause,
    seek,     //!< value: show time [s]
    seek_by,  //!< value: seconds
    step,     //!< value: frames, negative: backward; pauses
    speed,    //!< value: factor, negative: backward
    chapter,  //!< value: index from 0
    next_chapter,
    previous_chapter,
    loop,      //!< value: 0 or 1
    blackout,  //!< value: 1 dark, 0 light; faded
    toggle_blackout,
    exposure,  //!< value: stops in addition to the show's
    baseline,  //!< value: baseline [M]
    language,  //!< text: language tag
    next_language,
    captions,  //!< value: 0 or 1
    volume,    //!< value: factor, 0 to 1
    free_flight,
    return_to_path,
    reset,
    reload  //!< rereads the show's file
  };
  Kind kind = Kind::play;
  double value = 0.0;
  std::string text;
  std::string source{};  //!< sender, for the log: "web 192.168.1.20"; empty: this program

  //! Returns whether two commands do the same, regardless of their sources.
  bool operator==(const TransportCommand& other) const {
    return kind == other.kind && value == other.value && text == other.text;
  }
};

//! Returns whether a command changes the show's time, which is not allowed while an external clock
//! sets it.
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

//! Queues commands from other threads for the player, in order. The size is limited; when full, it
//! drops the oldest.
class CommandQueue {
 public:
  void push(TransportCommand command) {
    constexpr std::size_t maximum = 1024;
    const std::lock_guard lock(mutex_);
    if (commands_.size() >= maximum) {
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

//! The status of a controller, for operators.
struct PadStatus {
  std::string name;
  std::string connection;  //!< "USB", "Bluetooth"
  bool active = false;     //!< an input changed within the last second
};

struct ChapterStatus {
  double time_s = 0.0;
  std::string title;                //!< in the current language
  std::vector<std::string> titles;  //!< in all languages of the show
};

//! State of a node of a dome of several computers.
struct NodeStatus {
  std::string name;
  std::string state;      //!< "absent", "refused", "fetching", "joining", "joined", "behind" or "lost"
  double frame_ms = 0.0;  //!< usual time in which it renders a frame
  long late_frames = 0;
  long lost = 0;        //!< how often it was lost
  long rejoined = 0;    //!< how often it came back
  std::string problem;  //!< why it is refused; otherwise empty
};

//! State of the player, published once per frame.
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
  double baseline = 0.0;  //!< requested baseline [M]
  //! Baseline of the last frame [M]; smaller than requested where it had to be reduced.
  double baseline_used = 0.0;
  bool stereo = false;
  double volume = 1.0;
  std::string language;
  std::vector<std::string> languages;
  bool captions = true;
  int chapter = -1;  //!< index of the current chapter
  std::vector<ChapterStatus> chapters;
  //! Source of the show time, for display: "own", "MIDI time code".
  std::string clock;
  std::string follows;              //!< external clock that alone sets the time; empty: none
  std::string clock_state = "own";  //!< "own", "waiting", "following", "running_on" or "stopped"
  //! Time since the external clock was last received [s]; absent if it never was, or if there is no
  //! external clock.
  std::optional<double> clock_silence_s;
  std::string sound;     //!< name of the audio device, or that there is none; "off" if sound is switched off
  std::string observer;  //!< name of the observer, and its speed
  std::string lens;
  std::string backend;
  std::string display;  //!< state of the headset or of the nodes, if there are any; otherwise empty
  double frame_ms = 0.0;
  double worst_frame_ms = 0.0;  //!< longest frame time of the last ten seconds
  long frames = 0;
  long dropped_frames = 0;
  std::vector<PadStatus> pads;
  std::vector<NodeStatus> nodes;  //!< nodes of a dome of several computers
  std::string problem;            //!< the last problem; empty: none
};

//! Stores the latest status for other threads.
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
