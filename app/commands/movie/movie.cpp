#include "app/commands/movie/movie.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <iterator>
#include <optional>
#include <sstream>
#include <string_view>

#include "app/cli/interrupt.h"
#include "app/cli/usage_error.h"
#include "content/files/atomic_file.h"
#include "content/timeline/frame_rate.h"
#include "kernels/core/error.h"
#include "render/output/image_reader.h"

extern char** environ;  // NOLINT: POSIX's name

namespace ergodome {

namespace {

constexpr const char* encoder = "ffmpeg";
//! File descriptor from which ffmpeg reads the film's sound.
constexpr int sound_handle = 3;

//! A running program that reads from a pipe. Its messages are kept in memory, because the disk may
//! be full.
class Program {
 public:
  Program(const std::vector<std::string>& arguments, const MovieSound* sound)
      : messages_(::memfd_create("messages", MFD_CLOEXEC)) {
    int ends[2];
    if (messages_ < 0 || ::pipe2(ends, O_CLOEXEC) != 0) {
      throw Error(encoder, std::string("cannot be started: ") + std::strerror(errno),
                  "close other programs and try again");
    }
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[0], STDIN_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, messages_, STDERR_FILENO);
    if (sound != nullptr) {
      posix_spawn_file_actions_adddup2(&actions, sound->rewound(), sound_handle);
    }
    std::vector<char*> words;
    words.reserve(arguments.size() + 1);
    for (const std::string& argument : arguments) {
      words.push_back(const_cast<char*>(argument.c_str()));
    }
    words.push_back(nullptr);
    const int problem = posix_spawnp(&process_, encoder, &actions, nullptr, words.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    ::close(ends[0]);
    input_ = ends[1];
    if (problem != 0) {
      ::close(input_);
      throw Error(encoder, std::string("cannot be started: ") + std::strerror(problem),
                  "install ffmpeg, or encode the numbered frames with another program");
    }
  }
  ~Program() {
    static_cast<void>(finish());
    ::close(messages_);
  }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  //! Writes bytes to the program's input. Returns false if it stopped reading.
  [[nodiscard]] bool write(const char* bytes, std::size_t count) const { return write_all(input_, bytes, count); }

  //! Ends the input, waits for the program to end, and returns its exit status; -1 if a signal
  //! ended it.
  int finish() {
    if (!status_) {
      ::close(input_);
      int status = 0;
      while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
      }
      status_ = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }
    return *status_;
  }

  //! Returns the program's messages, or the last 64 KiB of them.
  [[nodiscard]] std::string messages() const {
    constexpr off_t maximum = 1 << 16;
    const off_t end = ::lseek(messages_, 0, SEEK_END);
    std::string text(static_cast<std::size_t>(std::clamp<off_t>(end, 0, maximum)), '\0');
    const ssize_t got = ::pread(messages_, text.data(), text.size(), std::max<off_t>(end - maximum, 0));
    text.resize(static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
    return text;
  }

 private:
  int messages_;
  pid_t process_ = 0;
  int input_ = -1;
  std::optional<int> status_;
};

std::string last_line(const std::string& text) {
  std::istringstream lines(text);
  std::string last;
  for (std::string line; std::getline(lines, line);) {
    if (!line.empty()) {
      last = line;
    }
  }
  return last.empty() ? "nothing" : last.substr(0, 300);
}

//! Returns the disk error that the messages name; empty if there is none.
std::string disk_problem(const std::string& messages) {
  for (const int problem : {ENOSPC, EDQUOT, EFBIG, EROFS, EIO}) {
    const std::string words = std::strerror(problem);
    if (messages.find(words) != std::string::npos) {
      return words;
    }
  }
  return {};
}

//! Reads the image file of a frame and sends its pixels to ffmpeg. Returns false if that stopped
//! reading. Throws Error if the image has another size than `size`.
bool send(const std::filesystem::path& file, bool alpha, const DisplayPixels& size, const Program& program) {
  const DisplayPixels pixels = alpha ? read_covering_pixels(file) : read_display_pixels(file);
  if (pixels.width != size.width || pixels.height != size.height) {
    throw Error(file.string(),
                fmt::format("has {} x {} pixels, but the first frame has {} x {}", pixels.width, pixels.height,
                            size.width, size.height),
                "render the frames again, without --resume");
  }
  return program.write(reinterpret_cast<const char*>(pixels.values.data()), 2 * pixels.values.size());
}

void encode(const Movie& movie, const std::filesystem::path& partial) {
  const DisplayPixels size = image_size(movie.pictures.front());
  Program program(movie_arguments(movie, size.width, size.height, partial), movie.sound);
  bool taken = true;
  for (const std::filesystem::path& picture : movie.pictures) {
    taken = taken && !interrupted() && send(picture, movie.alpha, size, program);
  }
  const int status = program.finish();
  const std::string message = program.messages();
  if (interrupted()) {
    throw Error(movie.file.string(), "was not finished", "the frames are complete; continue with --resume");
  }
  const bool ended_well = taken && status == 0;
  // ffmpeg may exit with status 0 although the disk is full, and only print a message.
  std::string disk = disk_problem(message);
  if (disk.empty() && !ended_well && disk_is_full(partial)) {
    disk = std::strerror(ENOSPC);
  }
  if (!disk.empty()) {
    throw Error(movie.file.string(), "cannot be written: " + disk,
                "the frames are complete; free some space or choose another folder, and continue with --resume");
  }
  if (!ended_well) {
    throw Error(movie.file.string(), fmt::format("ffmpeg stopped (status {}): {}", status, last_line(message)),
                "the frames are complete; try another format (.mp4, .mov, .mkv) or another encoder");
  }
  if (movie.sphere) {
    add_spherical_metadata(partial, movie.file.string(), movie_ending(movie.file), *movie.sphere);
  }
}

//! Returns the last number of frames in ffmpeg's progress report ("frame=24"); -1 if there is none.
long reported_frames(const std::string& report) {
  constexpr std::string_view key = "frame=";
  const std::size_t found = report.rfind(key);
  long frames = -1;
  if (found != std::string::npos) {
    const char* const end = report.data() + report.size();
    const char* begin = std::find_if(report.data() + found + key.size(), end, [](char c) { return c != ' '; });
    std::from_chars(begin, end, frames);
  }
  return frames;
}

//! Adds ffmpeg's arguments for the input and the codec of the sound; "-an" for a silent film.
void add_sound(const Movie& movie, const std::string& ending, std::vector<std::string>& words) {
  if (movie.sound == nullptr) {
    words.emplace_back("-an");
    return;
  }
  constexpr const char* format = std::endian::native == std::endian::little ? "f32le" : "f32be";
  for (const std::string& word :
       {std::string("-f"), std::string(format), std::string("-ar"), std::to_string(MovieSound::rate_hz),
        std::string("-ac"), std::string("2"), std::string("-i"), fmt::format("pipe:{}", sound_handle),
        std::string("-map"), std::string("0:v"), std::string("-map"), std::string("1:a")}) {
    words.push_back(word);
  }
  for (const char* word : ending == ".mp4" ? std::vector<const char*>{"-c:a", "aac", "-b:a", "256k"}
                                           : std::vector<const char*>{"-c:a", "pcm_s24le"}) {
    words.emplace_back(word);
  }
}

}  // namespace

std::string movie_ending(const std::filesystem::path& file) {
  constexpr std::array endings = {".mp4", ".mov", ".mkv"};
  std::string ending = file.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (std::ranges::find(endings, ending) == endings.end()) {
    throw UsageError("--movie " + file.string(), "has an unsupported extension", "choose .mp4, .mov or .mkv");
  }
  return ending;
}

bool holds_alpha(const std::string& ending) { return ending != ".mp4"; }

void require_movie_encoder(const std::filesystem::path& file) {
  static_cast<void>(movie_ending(file));
  require_writable(file);
  Program program({encoder, "-version"}, nullptr);
  if (program.finish() != 0) {
    throw Error(encoder, "does not work",
                "reinstall ffmpeg, or leave out --movie and encode the frames with another program");
  }
}

std::vector<std::string> movie_arguments(const Movie& movie, int width_px, int height_px,
                                         const std::filesystem::path& partial) {
  // H.264 levels allow widths up to 8192 px, but hardware decoders only up to 4096.
  constexpr int widest_h264_px = 4096;
  const std::string ending = movie_ending(movie.file);
  std::vector<std::string> words = {encoder, "-hide_banner", "-nostdin", "-loglevel", "error", "-xerror", "-y"};
  const auto add = [&](std::initializer_list<const char*> more) {
    words.insert(words.end(), more.begin(), more.end());
  };
  const std::string size = fmt::format("{}x{}", width_px, height_px);
  const FrameRate exact = frame_rate_of(movie.frame_rate_hz);
  const std::string rate = exact.seconds == 1001 ? fmt::format("{}/{}", exact.frames, exact.seconds)
                                                 : fmt::format("{:.10g}", movie.frame_rate_hz);
  const std::string pixels =
      std::string(movie.alpha ? "rgba64" : "rgb48") + (std::endian::native == std::endian::little ? "le" : "be");
  add({"-f", "rawvideo", "-pix_fmt", pixels.c_str(), "-s", size.c_str(), "-framerate", rate.c_str(), "-i", "pipe:0"});
  add_sound(movie, ending, words);
  // sRGB has the primaries of BT.709. The matrix must be given, or players guess it from the size.
  add({"-color_primaries", "bt709", "-color_trc", "iec61966-2-1"});
  if (ending == ".mkv") {
    add({"-c:v", "ffv1", "-level", "3", "-f", "matroska"});
  } else {
    // The ProRes encoder takes its color tags from the frames, not from the options.
    const std::string filters =
        std::string("pad=ceil(iw/2)*2:ceil(ih/2)*2:color=black@0,scale=out_color_matrix=bt709:out_range=limited,") +
        "setparams=color_primaries=bt709:color_trc=iec61966-2-1:colorspace=bt709:range=tv";
    add({"-vf", filters.c_str(), "-colorspace", "bt709", "-color_range", "tv"});
    if (ending == ".mov") {
      add({"-c:v", "prores_ks", "-profile:v", "4444", "-pix_fmt", movie.alpha ? "yuva444p10le" : "yuv444p10le", "-f",
           "mov"});
    } else if (width_px > widest_h264_px) {
      add({"-c:v", "libx265", "-crf", "14", "-preset", "medium", "-pix_fmt", "yuv420p", "-tag:v", "hvc1", "-movflags",
           "+faststart", "-f", "mp4"});
    } else {
      add({"-c:v", "libx264", "-crf", "14", "-preset", "medium", "-pix_fmt", "yuv420p", "-movflags", "+faststart", "-f",
           "mp4"});
    }
  }
  if (movie.sphere) {
    std::ranges::copy(spherical_arguments(*movie.sphere, ending), std::back_inserter(words));
  }
  words.push_back(partial.string());
  return words;
}

void write_movie(const Movie& movie) {
  write_atomically(movie.file, [&](const std::filesystem::path& partial) { encode(movie, partial); });
}

void check_movie(const Movie& movie) {
  Program program({encoder, "-hide_banner", "-nostdin", "-loglevel", "error", "-xerror", "-nostats", "-progress",
                   "pipe:2", "-i", movie.file.string(), "-map", "0", "-f", "null", "-"},
                  nullptr);
  const int status = program.finish();
  const std::string message = program.messages();
  const std::string file = movie.file.string();
  const char* const remedy = "no frame was deleted; make the film again with --resume, or with another encoder";
  if (interrupted()) {
    throw Error(file, "was written but not checked", "no frame was deleted; run the command again with --resume");
  }
  const long frames = reported_frames(message);
  if (status != 0) {
    throw Error(file, fmt::format("cannot be decoded completely (ffmpeg: {})", last_line(message)), remedy);
  }
  if (frames != static_cast<long>(movie.pictures.size())) {
    throw Error(file, fmt::format("has only {} of {} frames", std::max(frames, 0L), movie.pictures.size()), remedy);
  }
}

}  // namespace ergodome
