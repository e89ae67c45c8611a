// Simulates months of an exhibit within minutes: visitors come and go, pads are unplugged, a show
// file becomes invalid, a station of a trajectory file is damaged. Time is simulated; pictures are
// small and rendered by the CPU. Exits with status 1 if the use of resources grows, the exhibit
// hangs or an error message reaches the screen.
//
// ergodome_soak [FRAMES]   (default: 200000)
#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <random>
#include <thread>

#include "app/exhibit/exhibit_scenes.h"
#include "app/exhibit/log_file.h"
#include "app/pads/hid/hid_fixture.h"
#include "app/playback/show_reload.h"
#include "app/player/player_inputs.h"
#include "app/player/renderers/picture_flow.h"
#include "content/files/atomic_file.h"
#include "tests/support/baked_show.h"

namespace ergodome {
namespace {

constexpr const char* attract_text = R"(
title = "Attract"
duration_s = 10
[hole]
spin = 0.9
[camera]
[[camera.key]]
t_s = 0
r = 9
theta_deg = 70
yaw_deg = 30
[[camera.key]]
t_s = 10
r = 7
theta_deg = 80
phi_deg = 40
yaw_deg = 30
[sky]
map = "grid"
[view]
projection = "dome"
size_px = 200
[[caption]]
from_s = 2
to_s = 6
text = { en = "words", de = "Wörter" }
)";

constexpr int settled_frame = 20'000;  //!< resources must not grow after this frame
constexpr double max_growth = 1.01;
constexpr int picture_px = 24;

//! System resources that the process uses.
struct Held {
  double resident_mib = 0.0;
  long handles = 0;
  long threads = 0;
};

long entries_of(const char* folder) {
  return std::distance(std::filesystem::directory_iterator(folder), std::filesystem::directory_iterator());
}

Held held_now() {
  long pages = 0;
  long resident = 0;
  std::ifstream("/proc/self/statm") >> pages >> resident;
  return {static_cast<double>(resident * ::sysconf(_SC_PAGESIZE)) / (1 << 20), entries_of("/proc/self/fd"),
          entries_of("/proc/self/task")};
}

//! Returns a simulated pad. It is plugged in for 500 frames, then unplugged for 500 frames, and so
//! on. Its sticks never rest.
HidFixture restless_pad() {
  FixtureDevice pad;
  pad.info.path = "soak";
  pad.info.vendor = 0x046d;
  pad.info.product = 0xc216;
  pad.info.name = "Soak";
  pad.info.bus = HidBus::usb;
  pad.info.usages = {{1, 4}};
  pad.repeat_s = 1000.0 / 60.0;
  pad.timeline.push_back({0.0, HidEvent::Kind::connect, {}, {}, {}});
  std::mt19937 random(1);
  for (int i = 1; i < 400; ++i) {
    const auto stick = [&] { return static_cast<std::uint8_t>(random() & 0xFFU); };
    const auto buttons = static_cast<std::uint8_t>(8U | (i % 40 == 0 ? 0x20U : 0U));
    pad.timeline.push_back(
        {i / 50.0, HidEvent::Kind::report, {stick(), stick(), stick(), stick(), buttons, 0, 0, 0}, {}, {}});
  }
  pad.timeline.push_back({500.0 / 60.0, HidEvent::Kind::disconnect, {}, {}, {}});
  return {"made up", {pad}};
}

class Soak {
 public:
  explicit Soak(const std::filesystem::path& folder)
      : folder_(folder),
        file_(folder / "attract.toml"),
        exhibit_({.times = {.idle_s = 6.0, .session_s = 60.0}, .attract = {}, .state = folder / "state"},
                 visitor_show(), attract_show()),
        inputs_(Controls()),
        pads_(std::make_unique<FixturePlayer>(restless_pad(), [this] { return seconds(); }), {},
              [this] { return seconds(); }),
        flow_([this](const PictureAnswer& answer) { blank_ += answer.picture.rgba.empty() ? 1 : 0; }, picture_px),
        log_(open_log(folder / "log" / "ergodome.log", {})),
        reload_(file_, exhibit_.show(), std::chrono::system_clock::now() + std::chrono::seconds(1),
                [](const std::filesystem::path& path) { return read_show(path); }) {
    inputs_.set_lock(InputLock::visitors);
    begin();
  }

  void frame(int number) {
    now_ += std::chrono::nanoseconds(16'666'667);
    break_and_mend_the_show(number);
    pads_.poll();
    const PadSnapshot pads = pads_.snapshot();
    PlayerInput input = inputs_.gather({}, pads, 1e-3);
    // For 750 frames there is no visitor, then for 750 frames there is one, and so on.
    const bool visited = (number / 750) % 2 == 1;
    if (exhibit_.advance(seconds(), visited && inputs_.touched(), false)) {
      begin();
      log_->info("scene {}", static_cast<int>(exhibit_.scene()));
    }
    if (exhibit_.scene() == ExhibitScene::attract) {
      input.actions.clear();
      input.steering = {};
      if (number % 37 == 0) {
        input.commands.push_back({TransportCommand::Kind::seek, (number * 7919 % 10007) / 1000.7, {}});
      }
    }
    session_->advance(input);
    static_cast<void>(session_->take_requests());  // visitors may not quit
    if (const auto read = reload_.poll(now_)) {
      ++(read->show ? reloads_ : refused_);
      log_->info("reload: {}", read->problem);
      if (read->show && exhibit_.scene() == ExhibitScene::attract) {
        session_->set_show(*read->show);
      }
    }
    show_picture();
    PlayerStatus status;
    session_->fill(status);
    exhibit_.keep(status, false);
  }

  [[nodiscard]] bool good() const {
    return blank_ == 0 && problems_ == 0 && flow_.report().hangs == 0 && reloads_ > 0 && refused_ > 0 && visits_ > 0 &&
           damaged_ > 0;
  }

  [[nodiscard]] std::string report() const {
    return fmt::format("{} pictures, {} visits, {} reloads, {} broken ones kept off, {} problems",
                       flow_.report().pictures, visits_, reloads_, refused_, problems_);
  }

 private:
  [[nodiscard]] double seconds() const { return std::chrono::duration<double>(now_).count(); }

  Show attract_show() {
    write_text_atomically(file_, attract_text);
    return read_show(file_);
  }

  static Show visitor_show() {
    return parse_show(
        "[hole]\nspin = 0.9\n[camera]\n[[camera.key]]\nr = 9\n[sky]\nmap = \"grid\"\n[view]\nsize_px = 200\n",
        "visitor.toml");
  }

  //! Bakes the attract show and damages a station of the trajectory file. Returns a stream of this
  //! file.
  std::shared_ptr<StationStream> damaged_stream() {
    const std::filesystem::path file = folder_ / "attract.trajectory";
    const Show show = read_show(file_);
    test::bake_to(show, file, 0.01);
    const auto middle = static_cast<std::streamoff>(std::filesystem::file_size(file) / 2);
    std::fstream bytes(file, std::ios::in | std::ios::out | std::ios::binary);
    bytes.seekp(middle);
    bytes.write("damaged!", 8);
    bytes.close();
    return std::make_shared<StationStream>(Backend::cpu, TrajectoryReader(file), std::size_t{8} << 20U,
                                           [this](const std::string& problem) {
                                             ++damaged_;
                                             log_->warn("{}", problem);
                                           });
  }

  void begin() {
    const bool visitor = exhibit_.scene() == ExhibitScene::visitor;
    visits_ += visitor ? 1 : 0;
    std::shared_ptr<ShowRenderer>& renderer = visitor ? visitor_renderer_ : attract_renderer_;
    if (!renderer) {
      renderer = std::make_shared<ShowRenderer>(exhibit_.show(), Backend::cpu, LensChoice::automatic,
                                                visitor ? nullptr : damaged_stream());
    }
    session_.emplace(exhibit_.show(),
                     SessionOptions{.free_flight = visitor, .language = "en", .source = [this] { return now_; }});
  }

  void break_and_mend_the_show(int number) {
    if (number % 5000 == 500) {
      std::ofstream(file_) << "title = ";
    } else if (number % 5000 == 700) {
      write_text_atomically(file_, std::string(attract_text) + fmt::format("# {}\n", number));
    }
  }

  void show_picture() {
    PictureRequest wish;
    wish.renderer = exhibit_.scene() == ExhibitScene::visitor ? visitor_renderer_ : attract_renderer_;
    wish.frame = session_->frame();
    wish.captions = exhibit_.captions(true);
    wish.captions_opacity = exhibit_.opacity();
    if (!session_->changed()) {
      return;
    }
    PictureNews news = flow_.advance(wish, true, true);
    while (news == PictureNews::none) {
      std::this_thread::sleep_for(std::chrono::microseconds(50));
      news = flow_.advance(wish, false, true);
    }
    problems_ += news == PictureNews::picture ? 0 : 1;
  }

  std::filesystem::path folder_;
  std::filesystem::path file_;
  MonotonicTime now_ = std::chrono::seconds(1'000'000'000);
  ExhibitScenes exhibit_;
  PlayerInputs inputs_;
  PadHub pads_;
  PictureFlow flow_;
  std::shared_ptr<spdlog::logger> log_;
  ShowReload reload_;
  std::shared_ptr<ShowRenderer> attract_renderer_;
  std::shared_ptr<ShowRenderer> visitor_renderer_;
  std::optional<PlayerSession> session_;
  long blank_ = 0;
  long problems_ = 0;
  long reloads_ = 0;
  long refused_ = 0;
  long visits_ = 0;
  std::atomic<long> damaged_ = 0;
};

int run(int frames) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / fmt::format("ergodome-soak-{}", ::getpid());
  std::filesystem::create_directories(folder);
  bool good = true;
  {
    Soak soak(folder);
    Held settled;
    for (int i = 1; i <= frames; ++i) {
      soak.frame(i);
      if (i == std::min(settled_frame, frames / 2)) {
        settled = held_now();
      }
      if (i % std::max(frames / 10, 1) == 0) {
        const Held now = held_now();
        fmt::print("{:>8} frames  {:.1f} MiB  {} handles  {} threads  {}\n", i, now.resident_mib, now.handles,
                   now.threads, soak.report());
        std::fflush(stdout);
      }
    }
    const Held last = held_now();
    good = soak.good() && last.handles <= settled.handles && last.threads <= settled.threads &&
           (frames < 2 * settled_frame || last.resident_mib <= max_growth * settled.resident_mib);
    std::uintmax_t log_bytes = 0;
    for (const auto& each : std::filesystem::directory_iterator(folder / "log")) {
      log_bytes += each.file_size();
    }
    good = good && log_bytes <= 5U << 20U;
    fmt::print("from {:.1f} to {:.1f} MiB, log {} bytes: {}\n", settled.resident_mib, last.resident_mib, log_bytes,
               good ? "good" : "NOT GOOD");
  }
  std::filesystem::remove_all(folder);
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace
}  // namespace ergodome

int main(int count, char** words) {
  const int frames = count > 1 ? std::atoi(words[1]) : 200'000;
  return ergodome::run(std::max(frames, 10));
}
