#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "app/playback/show_reload.h"
#include "content/show/reading/show_reader.h"
#include "kernels/core/error.h"

namespace {

//! Returns the path of a show file that is saved again and again; on a file system in memory, if
//! there is one.
const std::filesystem::path& show_file() {
  static const std::filesystem::path file = [] {
    const std::filesystem::path memory = "/dev/shm";
    const std::filesystem::path folder =
        std::filesystem::is_directory(memory) ? memory : std::filesystem::temp_directory_path();
    return folder / ("ergodome-fuzz-" + std::to_string(::getpid()) + ".toml");
  }();
  return file;
}

}  // namespace

// While a show runs, any text may be saved to its file. The player's reader must either return the
// next version of the show or report a problem.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::ofstream(show_file(), std::ios::binary)
      .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  ergodome::Show running;
  running.name = "running";
  ergodome::ShowReload reload(show_file(), running, std::chrono::system_clock::now(), ergodome::read_show);
  reload.request();
  std::optional<ergodome::ShowReload::Result> result;
  do {
    result = reload.poll(std::chrono::seconds(1));
  } while (!result);
  if (result->show.has_value() == !result->problem.empty()) {
    std::abort();
  }
  std::filesystem::remove(show_file());
  return 0;
}
