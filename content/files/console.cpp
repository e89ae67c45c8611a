#include "content/files/console.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <string>

#include "content/files/printable.h"

namespace ergodome {

namespace {

//! errno of the first failure to write the standard output; 0 if there was none.
int output_problem = 0;

void write_to(std::FILE* stream, std::string_view text) {
  // Escapes all control characters except line breaks and tabs.
  std::string shown;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find_first_of("\n\t", begin), text.size());
    shown += printable(text.substr(begin, end - begin));
    shown += text.substr(end, 1);
    begin = end + 1;
  }
  errno = 0;
  if (std::fwrite(shown.data(), 1, shown.size(), stream) != shown.size() && stream == stdout && output_problem == 0) {
    output_problem = errno != 0 ? errno : EIO;
  }
}

}  // namespace

void prepare_console() {
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(descriptor, F_GETFD) < 0 && errno == EBADF) {
      // The descriptor is opened for reading only, so that printing to it fails, as it would have
      // while it was closed.
      static_cast<void>(::open("/dev/null", O_RDONLY));
    }
  }
  std::signal(SIGPIPE, SIG_IGN);
}

void print_text(std::string_view text) { write_to(stdout, text); }

void note_text(std::string_view text) { write_to(stderr, fmt::format("ergodome: {}\n", text)); }

bool finish_output() {
  errno = 0;
  std::cout.flush();  // flushes the help text of the parser, and stdout
  const bool failed = std::fflush(stdout) != 0 || std::ferror(stdout) != 0;
  if (failed && output_problem == 0) {
    output_problem = errno != 0 ? errno : EIO;
  }
  if (output_problem != 0 && output_problem != EPIPE) {
    print_note("cannot write the output: {}; free some space, or redirect it elsewhere", std::strerror(output_problem));
  }
  return output_problem == 0;
}

}  // namespace ergodome
