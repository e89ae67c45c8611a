#include "app/playback/sound/audio_messages.h"

#include <alsa/asoundlib.h>

#include <cstdlib>
#include <mutex>

namespace ergodome {

namespace {

void say_nothing(const char* /*file*/, int /*line*/, const char* /*function*/, int /*number*/, const char* /*format*/,
                 ...) {}

}  // namespace

void silence_sound_libraries() {
  static std::once_flag once;
  std::call_once(once, [] {
    snd_lib_error_set_handler(say_nothing);
    // OpenAL Soft reads this variable on first use. A user's value is kept.
    ::setenv("ALSOFT_LOGLEVEL", "0", 0);
  });
}

}  // namespace ergodome
