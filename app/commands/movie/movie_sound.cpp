#include "app/commands/movie/movie_sound.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "app/cli/interrupt.h"
#include "app/cli/lens_options.h"
#include "app/playback/playback.h"
#include "app/playback/sound/audio_file.h"
#include "app/playback/sound/audio_mixer.h"
#include "app/playback/sound/audio_output.h"
#include "content/files/atomic_file.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

//! Interval at which the show time is evaluated, 10 ms in sound samples; fades change in steps of
//! this length.
constexpr int step_frames = MovieSound::rate_hz / 100;

Error sound_refused(const std::filesystem::path& folder) {
  return {folder.string(), std::string("cannot store the sound of a film: ") + std::strerror(errno),
          "free some space or choose another folder"};
}

//! Creates an unnamed temporary file on the disk of a folder.
int open_nameless(const std::filesystem::path& folder) {
  std::string name = ((folder.empty() ? "." : folder) / ".partial-sound-XXXXXX").string();
  const int file = ::mkostemp(name.data(), O_CLOEXEC);
  if (file < 0) {
    throw sound_refused(folder);
  }
  ::unlink(name.c_str());
  return file;
}

//! Prints a note if a sound file is damaged; it is played up to the damage.
void report_file(const std::filesystem::path& file) {
  const std::string problem = sound_problem(file);
  if (!problem.empty()) {
    print_note_once(problem);
  }
}

}  // namespace

MovieSound::MovieSound(const Show& show, const std::string& language, double from_s, double length_s,
                       const std::filesystem::path& folder)
    : file_(folder) {
  silence_sound_libraries();
  const auto output = AudioOutput::open_memory(rate_hz);
  MonotonicTime now{};
  PlaybackSettings settings;
  settings.language = language;
  const std::string spoken = Playback(show, settings).language();
  const Soundtrack soundtrack = soundtrack_of(show);
  for (const AudioTrack& track : soundtrack.tracks) {
    if (track.language.empty() || track.language == spoken) {
      report_file(soundtrack.folder / track.file);
    }
  }
  AudioMixer mixer(*output, soundtrack, [&now] { return now; });
  const auto frames = static_cast<std::int64_t>(std::llround(length_s * rate_hz));
  for (std::int64_t done = 0; done < frames && !interrupted(); done += step_frames) {
    const double since_s = static_cast<double>(done) / rate_hz;
    now = MonotonicTime(show_time(since_s));
    ShowInstant instant;
    instant.time = show_time(from_s + since_s);
    instant.playing = true;
    instant.speed = 1.0;
    instant.now = now;
    mixer.update({instant, 1.0, spoken});
    const auto count = static_cast<std::size_t>(std::min<std::int64_t>(step_frames, frames - done));
    const std::vector<float> samples = output->render(step_frames);
    if (!write_all(file_.handle, reinterpret_cast<const char*>(samples.data()), 2 * count * sizeof(float))) {
      throw sound_refused(folder);
    }
  }
  for (const std::string& problem : mixer.take_problems()) {
    print_note_once(problem);
  }
}

MovieSound::NamelessFile::NamelessFile(const std::filesystem::path& folder) : handle(open_nameless(folder)) {}

MovieSound::NamelessFile::~NamelessFile() { ::close(handle); }

int MovieSound::rewound() const {
  ::lseek(file_.handle, 0, SEEK_SET);
  return file_.handle;
}

}  // namespace ergodome
