#include "app/player/cluster_node_player.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <utility>

#include "app/cli/interrupt.h"
#include "app/player/cluster_frames.h"
#include "app/player/cluster_gate.h"
#include "content/files/console.h"
#include "kernels/core/error.h"
#include "render/present/projectors/headless_projectors.h"

namespace ergodome {

namespace {

class OutputWithoutWindows : public DisplayOutput {
 public:
  explicit OutputWithoutWindows(const std::vector<ProjectorPicture>& pictures)
      : count_(pictures.size()), projectors_(pictures, ProjectorDrawer::processor) {}

  [[nodiscard]] OutputWish wish() override { return {}; }
  void take(OutputFrame& frame) override { picture_ = frame.picture; }
  void set_light(double /*light*/) override {}
  void show() override {
    if (picture_.rgba.empty()) {
      return;
    }
    projectors_.show(picture_);
    for (std::size_t i = 0; i < count_; ++i) {
      (void)projectors_.frame(i);
    }
  }
  [[nodiscard]] bool closed() const override { return closed_; }
  void close() override { closed_ = true; }
  [[nodiscard]] bool is_dome() const override { return true; }

 private:
  std::size_t count_;
  HeadlessProjectors projectors_;
  Picture picture_;
  bool closed_ = false;
};

std::unique_ptr<NodeChannel> connect_to_master(const NodeOptions& options) {
  std::string problem;
  auto channel = cluster_library().connect(options.host, options.port, options.keys, options.name, problem);
  if (!channel) {
    throw Error("--master", fmt::format("cannot connect to {}:{}: {}", options.host, options.port, problem),
                "give the master's name or IPv4 address, as in --master 10.0.0.1");
  }
  return channel;
}

}  // namespace

std::unique_ptr<DisplayOutput> output_without_windows(const std::vector<ProjectorPicture>& pictures) {
  return std::make_unique<OutputWithoutWindows>(pictures);
}

ClusterNodePlayer::ClusterNodePlayer(const NodeOptions& options, RendererLoader::Make make,
                                     std::unique_ptr<DisplayOutput> output)
    : options_(options), make_(std::move(make)), output_(std::move(output)), log_(options.frame_log) {
  load();
  channel_ = connect_to_master(options_);
  node_.emplace(*channel_, ClusterNode::Settings{options_.name, options_.identity}, cluster_seconds);
}

ClusterNodePlayer::~ClusterNodePlayer() = default;

void ClusterNodePlayer::load() {
  const auto read_at = std::chrono::system_clock::now();
  show_ = options_.load();
  renderer_ = make_(show_);
  options_.identity.show = show_fingerprint(show_);
  options_.identity.content = content_fingerprint(show_);
  files_.watch(files_of(file_of(show_), show_), read_at);
}

void ClusterNodePlayer::run() {
  constexpr double wait_s = 0.002;
  while (!output_->closed() && !interrupted()) {
    channel_->wait(wait_s);
    node_->poll();
    report();
    reload_show();
    start_next();
    show_released();
  }
}

void ClusterNodePlayer::report() {
  for (const ClusterNews& news : node_->take_news()) {
    print_note("{}", news.text);
  }
}

void ClusterNodePlayer::reload_show() {
  const bool changed = files_.changed(std::chrono::steady_clock::now().time_since_epoch());
  if ((!node_->show_wanted() && !changed) || !source_.idle()) {
    return;
  }
  try {
    load();
  } catch (const std::exception& problem) {
    // The last picture stays, and the master refuses the node until the files are correct.
    print_note("{}", problem.what());
  }
  node_->set_show(options_.identity.show, options_.identity.content);
}

void ClusterNodePlayer::start_next() {
  // A newer frame replaces one that waits for its release only after it was shown or rendered.
  if (!source_.idle() || (next_ && !next_->answer)) {
    return;
  }
  if (next_ && !node_->may_show(next_->work.frame.number)) {
    return;
  }
  std::optional<ClusterNode::Work> work = node_->take_work();
  if (!work) {
    return;
  }
  show_released();
  PictureRequest request;
  request.renderer = renderer_;
  if (work->runs_on) {
    const double time_s = std::min(1e-9 * static_cast<double>(work->frame.time_ns), show_.duration_s);
    work->frame.time_ns = static_cast<std::int64_t>(1e9 * time_s);
    work->frame.pose = camera_pose(show_, time_s);
  }
  apply(work->frame, request);
  request.followed_stops = work->frame.followed_stops;
  next_ = Shown{std::move(*work), {}};
  source_.ask(request);
}

void ClusterNodePlayer::show_released() {
  constexpr double events_every_s = 0.1;
  if (next_ && !next_->answer) {
    if (auto answer = source_.take()) {
      if (!answer->problem.empty()) {
        print_note("{}", answer->problem);
        next_.reset();
      } else {
        if (!next_->work.runs_on) {
          node_->report_ready(next_->work.frame.number, answer->time_ms);
        }
        next_->answer = std::move(answer);
        // The picture is uploaded before its release, so that showing it takes no time.
        if (log_.wanted()) {
          log_picture_ = next_->answer->picture;
        }
        output_->take(*next_->answer);
      }
    }
  }
  const double light = node_->light();
  const bool dimmed = std::exchange(light_, light) != light;
  if (dimmed) {
    output_->set_light(light);
  }
  if (next_ && next_->answer && node_->may_show(next_->work.frame.number)) {
    output_->show();
    if (!next_->work.runs_on) {
      log_.add(next_->work.frame, log_picture_);
    }
    next_.reset();
  } else if (dimmed && !next_) {
    output_->show();
  }
  if (const double now_s = cluster_seconds(); now_s - events_s_ > events_every_s) {
    events_s_ = now_s;
    // Keys do nothing on a node, but windows must handle their events.
    (void)output_->events();
  }
}

}  // namespace ergodome
