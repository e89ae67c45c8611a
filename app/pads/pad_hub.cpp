#include "app/pads/pad_hub.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <limits>

namespace ergodome {

namespace {

constexpr double scan_every_s = 1.0;
constexpr std::size_t longest_report = 65'536;
constexpr std::size_t max_pads = 16;
//! Time to wait for a controller's first report, if one or if several are open. With several it is
//! short, so that none delays another.
constexpr int one_pad_wait_ms = 8;
constexpr int several_pads_wait_ms = 2;
constexpr int no_pad_wait_ms = 200;

std::string connection_name(HidBus bus) {
  switch (bus) {
    case HidBus::usb:
      return "USB";
    case HidBus::bluetooth:
      return "Bluetooth";
    default:
      return "other";
  }
}

std::function<double()> seconds_since_now() {
  const auto start = std::chrono::steady_clock::now();
  return [start] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); };
}

void add(PadPresses& sum, const PadPresses& more) {
  for (std::size_t i = 0; i < sum.size(); ++i) {
    sum[i] = static_cast<std::uint16_t>(std::min<int>(sum[i] + more[i], std::numeric_limits<std::uint16_t>::max()));
  }
}

}  // namespace

PadIdentity identity_of(const HidDeviceInfo& info, std::string_view model) {
  return {info.vendor,
          info.product,
          info.name.empty() ? device_id(info.vendor, info.product) : info.name,
          info.serial,
          connection_name(info.bus),
          info.path,
          std::string(model)};
}

std::string permission_remedy(const HidDeviceInfo& info) {
  return fmt::format(
      "no permission to read {}; install the udev rules 69-ergodome.rules "
      "(see how-to/connect-a-pad.md in the documentation), then reconnect the controller",
      info.path);
}

PadState PadSnapshot::merged() const {
  PadState all;
  for (const PadView& pad : pads) {
    for (std::size_t i = 0; i < pad_axis_count; ++i) {
      if (std::abs(pad.state.axes[i]) > std::abs(all.axes[i])) {
        all.axes[i] = pad.state.axes[i];
      }
    }
    all.buttons |= pad.state.buttons;
  }
  return all;
}

int PadSnapshot::presses(PadButton button) const {
  int sum = 0;
  for (const PadView& pad : pads) {
    sum += pad.presses[static_cast<std::size_t>(button)];
  }
  return sum;
}

double PadSnapshot::last_input_s() const {
  double last = -std::numeric_limits<double>::infinity();
  for (const PadView& pad : pads) {
    last = std::max(last, pad.last_input_s);
  }
  return last;
}

PadHub::PadHub(std::unique_ptr<HidApi> api, PadSettings settings, std::function<double()> now_s)
    : api_(std::move(api)),
      settings_(std::move(settings)),
      now_s_(now_s ? std::move(now_s) : seconds_since_now()),
      buffer_(longest_report),
      next_scan_s_(-std::numeric_limits<double>::infinity()),
      problem_(api_->init()) {}

PadHub::~PadHub() { stop(); }

void PadHub::start() {
  thread_ = std::thread([this] { run(); });
}

void PadHub::stop() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  wake_.notify_all();
  if (thread_.joinable()) {
    thread_.join();
  }
}

void PadHub::run() {
  do {
    poll(sessions_.size() == 1 ? one_pad_wait_ms : 0);
  } while (wait(sessions_.empty() ? no_pad_wait_ms : sessions_.size() == 1 ? 0 : several_pads_wait_ms));
}

bool PadHub::wait(int milliseconds) {
  std::unique_lock lock(mutex_);
  wake_.wait_for(lock, std::chrono::milliseconds(milliseconds), [this] { return stopping_; });
  return !stopping_;
}

void PadHub::use(PadSettings settings) {
  const std::lock_guard lock(mutex_);
  new_settings_ = std::make_unique<PadSettings>(std::move(settings));
}

void PadHub::take_new_settings() {
  std::unique_ptr<PadSettings> settings;
  {
    const std::lock_guard lock(mutex_);
    settings = std::move(new_settings_);
  }
  if (settings == nullptr) {
    return;
  }
  settings_ = std::move(*settings);
  for (const auto& session : sessions_) {
    publish_gone(*session);
  }
  sessions_.clear();
  next_scan_s_ = -std::numeric_limits<double>::infinity();
}

void PadHub::poll(int wait_ms) {
  take_new_settings();
  const double now = now_s_();
  if (now >= next_scan_s_) {
    rescan(now);
    next_scan_s_ = now + scan_every_s;
  }
  if (pump(wait_ms)) {
    // A controller is gone. It may already be connected again under another path, so the next scan
    // is soon.
    next_scan_s_ = std::min(next_scan_s_, now + 0.25);
  }
  publish(now_s_());
}

void PadHub::rescan(double now_s) {
  const std::uint64_t mark = api_->change_mark();
  if (mark == 0 || mark != mark_) {
    listed_ = api_->enumerate();
    mark_ = mark;
  }
  find_pads(now_s);
}

void PadHub::find_pads(double now_s) {
  denied_.clear();
  for (const HidDeviceInfo& info : listed_) {
    const bool is_open = std::any_of(sessions_.begin(), sessions_.end(),
                                     [&](const auto& session) { return session->identity()->path == info.path; });
    if (!is_open && sessions_.size() < max_pads && is_pad(info)) {
      open(info, now_s);
    }
  }
}

void PadHub::open(const HidDeviceInfo& info, double now_s) {
  const PadProfile& profile = profile_for(settings_, identity_of(info, ""));
  if (profile.ignore) {
    return;
  }
  HidOpening opening = api_->open_path(info.path);
  if (opening.device == nullptr) {
    if (denied_.size() < max_pads) {
      PadView view;
      view.identity = std::make_shared<const PadIdentity>(identity_of(info, ""));
      view.problem = opening.denied ? permission_remedy(info) : opening.problem;
      denied_.push_back(std::move(view));
    }
    return;
  }
  std::unique_ptr<PadDecoder> decoder = make_pad_decoder(info, opening.device->descriptor());
  if (decoder == nullptr) {
    return;
  }
  PadIdentity identity = identity_of(info, decoder->model());
  sessions_.push_back(std::make_unique<PadSession>(std::move(identity), std::move(opening.device), std::move(decoder),
                                                   profile, settings_.stuck_after_s, now_s));
}

//! Reads all controllers. Returns true if one is gone.
bool PadHub::pump(int wait_ms) {
  const std::size_t before = sessions_.size();
  std::erase_if(sessions_, [&](const auto& session) {
    if (session->pump(buffer_, now_s_, wait_ms) >= 0) {
      session->watch(now_s_());
      return false;
    }
    publish_gone(*session);
    return true;
  });
  return sessions_.size() < before;
}

int PadHub::free_number() const {
  int number = 1;
  const auto is_taken = [&](const PadView& view) { return view.connected && view.number == number; };
  while (std::any_of(views_.begin(), views_.end(), is_taken)) {
    ++number;
  }
  return number;
}

PadView& PadHub::view_of(const PadSession& session) {
  const auto found = std::find_if(views_.begin(), views_.end(),
                                  [&](const PadView& view) { return view.identity == session.identity(); });
  if (found != views_.end()) {
    return *found;
  }
  PadView fresh;
  fresh.identity = session.identity();
  fresh.number = free_number();
  fresh.connected = true;
  views_.push_back(std::move(fresh));
  return views_.back();
}

void PadHub::publish_gone(PadSession& session) {
  session.release();
  const std::lock_guard lock(mutex_);
  PadView& view = view_of(session);
  view.connected = false;
  view.state = {};
  view.stuck = false;
  view.last_input_s = session.last_input_s();
  add(view.presses, session.take_presses());
}

void PadHub::publish(double now_s) {
  const std::lock_guard lock(mutex_);
  published_s_ = now_s;
  shown_problem_ = problem_;
  std::erase_if(views_, [](const PadView& view) { return !view.problem.empty(); });
  for (const auto& session : sessions_) {
    PadView& view = view_of(*session);
    view.absent = session->absent();
    view.stuck = session->stuck();
    view.state = session->state();
    view.last_report_s = session->last_report_s();
    view.last_input_s = session->last_input_s();
    view.reports = session->reports();
    view.refused = session->refused();
    add(view.presses, session->take_presses());
  }
  views_.insert(views_.end(), denied_.begin(), denied_.end());
  // If no snapshots are taken, removed controllers must not accumulate.
  while (views_.size() > 4 * max_pads) {
    const auto gone = std::find_if(views_.begin(), views_.end(), [](const PadView& view) { return !view.connected; });
    if (gone == views_.end()) {
      break;
    }
    views_.erase(gone);
  }
}

PadSnapshot PadHub::snapshot() {
  const std::lock_guard lock(mutex_);
  PadSnapshot snapshot{published_s_, views_, shown_problem_};
  std::erase_if(views_, [](const PadView& view) { return !view.connected && view.problem.empty(); });
  for (PadView& view : views_) {
    view.presses = {};
  }
  return snapshot;
}

}  // namespace ergodome
