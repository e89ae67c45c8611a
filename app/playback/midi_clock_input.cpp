#include "app/playback/midi_clock_input.h"

#include <alsa/asoundlib.h>
#include <fmt/format.h>
#include <rtmidi/RtMidi.h>

#include <algorithm>
#include <utility>

#include "app/playback/sound/audio_output.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

void ignore_message(RtMidiError::Type /*type*/, const std::string& /*text*/, void* /*nothing*/) {}

//! Returns whether the machine has a MIDI sequencer. RtMidi would print an error without one,
//! before it can be silenced.
bool has_sequencer() {
  silence_sound_libraries();
  snd_seq_t* sequencer = nullptr;
  if (snd_seq_open(&sequencer, "default", SND_SEQ_OPEN_INPUT, 0) < 0) {
    return false;
  }
  snd_seq_close(sequencer);
  return true;
}

std::unique_ptr<RtMidiIn> open_midi() {
  if (!has_sequencer()) {
    return nullptr;
  }
  try {
    auto input = std::make_unique<RtMidiIn>(RtMidi::LINUX_ALSA, "Ergodome");
    input->setErrorCallback(ignore_message);
    return input;
  } catch (const RtMidiError&) {
    return nullptr;
  }
}

std::vector<std::string> names_of(RtMidiIn& input) {
  std::vector<std::string> names;
  const unsigned int count = input.getPortCount();
  names.reserve(count);
  for (unsigned int i = 0; i < count; ++i) {
    names.push_back(input.getPortName(i));
  }
  return names;
}

}  // namespace

std::vector<std::string> midi_input_names() {
  const auto input = open_midi();
  return input ? names_of(*input) : std::vector<std::string>{};
}

MidiClockInput::MidiClockInput(std::shared_ptr<ExternalClock> clock, const std::string& port,
                               std::optional<TimeCode> start, TimeSource source)
    : clock_(std::move(clock)), source_(std::move(source)), filter_(start), input_(open_midi()) {
  const std::vector<std::string> names = input_ ? names_of(*input_) : std::vector<std::string>{};
  const auto found =
      std::ranges::find_if(names, [&](const std::string& name) { return name.find(port) != std::string::npos; });
  if (found == names.end()) {
    throw Error("--clock mtc",
                port.empty() ? "no MIDI input was found" : fmt::format("no MIDI input is named '{}'", port),
                names.empty() ? "connect one and load ALSA's sequencer (modprobe snd-seq)"
                              : fmt::format("choose from: {}", fmt::join(names, ", ")));
  }
  port_ = *found;
  // By default the library drops the messages that time code needs. Enables system exclusive and
  // timing, not active sensing.
  input_->ignoreTypes(false, false, true);
  input_->setCallback(receive, this);
  input_->openPort(static_cast<unsigned int>(found - names.begin()), "time code");
  if (!input_->isPortOpen()) {
    throw Error("--clock mtc", fmt::format("the MIDI input '{}' cannot be opened", port_),
                "close other programs that use it");
  }
}

MidiClockInput::~MidiClockInput() = default;

void MidiClockInput::receive(double /*since_last_s*/, std::vector<unsigned char>* bytes, void* self) {
  auto& input = *static_cast<MidiClockInput*>(self);
  const MonotonicTime now = input.source_();
  for (const auto& reading : input.reader_.read(*bytes)) {
    input.clock_->post(input.filter_.filter(reading, now));
  }
}

std::shared_ptr<ExternalClock> make_midi_clock() {
  return std::make_shared<ExternalClock>("MIDI time code", std::chrono::seconds(1));
}

}  // namespace ergodome
