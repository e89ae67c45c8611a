#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/playback/midi_time_code.h"

class RtMidiIn;

namespace ergodome {

//! Returns the names of the machine's MIDI inputs; empty if it has no inputs.
std::vector<std::string> midi_input_names();

//! Receives MIDI time code from an input, on a thread of the MIDI library, and posts clock fixes.
class MidiClockInput {
 public:
  //! `port` is part of the input's name, or empty for the first one. `start` is the time code at
  //! which the show's time is 0. Throws Error if no input matches, with a list of the inputs, or if
  //! it cannot be opened.
  MidiClockInput(std::shared_ptr<ExternalClock> clock, const std::string& port, std::optional<TimeCode> start,
                 TimeSource source = steady_time);
  ~MidiClockInput();
  MidiClockInput(const MidiClockInput&) = delete;
  MidiClockInput& operator=(const MidiClockInput&) = delete;

  [[nodiscard]] const std::string& port() const { return port_; }

 private:
  static void receive(double since_last_s, std::vector<unsigned char>* bytes, void* self);

  std::shared_ptr<ExternalClock> clock_;
  TimeSource source_;
  MidiTimeCodeReader reader_;
  TimeCodeFilter filter_;
  std::unique_ptr<RtMidiIn> input_;
  std::string port_;
};

//! Returns the clock driven by MIDI time code. The clock stays valid for a second after the last
//! quarter frame.
std::shared_ptr<ExternalClock> make_midi_clock();

}  // namespace ergodome
