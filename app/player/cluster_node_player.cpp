#include "app/player/cluster_node_player.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <utility>

#include "app/cli/interrupt.h"
#include "app/exhibit/supervisor.h"
#include "app/player/cluster_frames.h"
#include "app/player/cluster_gate.h"
#include "content/files/console.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

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

ClusterNodePlayer::ClusterNodePlayer(const NodeOptions& options, RendererLoader::Make make,
                                     std::unique_ptr<DisplayOutput> output)
    : options_(options),
      make_(std::move(make)),
      output_(std::move(output)),
      calibration_(options.setup, options.name),
      log_(options.frame_log) {
  load();
  channel_ = connect_to_master(options_);
  node_.emplace(*channel_, ClusterNode::Settings{options_.name, options_.identity}, cluster_seconds);
}

ClusterNodePlayer::~ClusterNodePlayer() = default;

void ClusterNodePlayer::load() {
  const auto read_at = std::chrono::system_clock::now();
  std::vector<Show> shows = options_.load(pushed_);
  std::vector<std::shared_ptr<ShowRenderer>> renderers;
  std::vector<std::filesystem::path> files;
  for (const Show& show : shows) {
    renderers.push_back(make_(show));
    const std::vector<std::filesystem::path> its_files = files_of(file_of(show), show);
    files.insert(files.end(), its_files.begin(), its_files.end());
  }
  shows_ = std::move(shows);
  renderers_ = std::move(renderers);
  options_.identity.show = fingerprint_of_shows(shows_);
  options_.identity.content = fingerprint_of_contents(shows_);
  files_.watch(files, read_at);
}

void ClusterNodePlayer::run() {
  constexpr double wait_s = 0.002;
  notify_supervisor_ready();
  while (!output_->closed() && !interrupted()) {
    channel_->wait(wait_s);
    node_->poll();
    report();
    reload_show();
    fetch();
    start_next();
    show_released();
    follow_light();
    join_swap_group();
    notify_supervisor_alive(cluster_seconds());
  }
}

void ClusterNodePlayer::report() {
  for (const ClusterNews& news : node_->take_news()) {
    print_note("{}", news.text);
    notify_supervisor(news.text);
  }
}

void ClusterNodePlayer::reload_show() {
  files_changed_ = files_.changed(std::chrono::steady_clock::now().time_since_epoch()) || files_changed_;
  if ((!node_->show_wanted() && !files_changed_) || !source_.idle()) {
    return;
  }
  files_changed_ = false;
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
  std::size_t scene = 0;
  if (!shows_.empty()) {
    scene = std::min<std::size_t>(work->frame.attract ? 1 : 0, shows_.size() - 1);
    request.renderer = renderers_[scene];
  } else if (work->frame.pattern == ClusterPattern::none) {
    return;
  }
  if (work->runs_on) {
    const double time_s = std::min(1e-9 * static_cast<double>(work->frame.time_ns), shows_[scene].duration_s);
    work->frame.time_ns = static_cast<std::int64_t>(1e9 * time_s);
    work->frame.pose = camera_pose(shows_[scene], time_s);
  }
  apply(work->frame, request);
  request.captions = node_->captions_of(work->frame);
  request.captions_opacity = work->frame.texts_opacity;
  request.followed_stops = work->frame.followed_stops;
  show_calibration(work->frame);
  request.pattern = calibration_.pattern_of(work->frame);
  next_ = Shown{std::move(*work), {}};
  source_.ask(request);
}

void ClusterNodePlayer::show_calibration(const ClusterFrame& frame) {
  try {
    if (calibration_.follow(frame, node_->calibration())) {
      output_->set_projectors(calibration_.pictures());
    }
    if (calibration_.rasters_change(frame)) {
      output_->set_rasters(calibration_.rasters(frame));
    }
    if (shown_texts_ != calibration_.texts()) {
      shown_texts_ = calibration_.texts();
      output_->set_projector_texts(shown_texts_);
    }
  } catch (const std::exception& problem) {
    // The last warps stay until the operator makes the setup valid again.
    print_note("{}", problem.what());
  }
}

void ClusterNodePlayer::take_answer() {
  if (!next_ || next_->answer) {
    return;
  }
  std::optional<PictureAnswer> answer = source_.take();
  if (!answer) {
    return;
  }
  if (!answer->problem.empty()) {
    print_note("{}", answer->problem);
    next_.reset();
    return;
  }
  const ClusterFrame& frame = next_->work.frame;
  if (!next_->work.runs_on) {
    node_->report_ready(frame.number, answer->time_ms);
  }
  if (frame.followed_stops) {
    show_with_stops(*frame.followed_stops, *answer);
  }
  next_->answer = std::move(answer);
  // The picture is uploaded before its release, so that showing it takes no time.
  if (log_.wanted()) {
    log_picture_ = next_->answer->picture;
  }
  output_->take(*next_->answer);
}

void ClusterNodePlayer::show_released() {
  take_answer();
  if (!next_ || !next_->answer || !node_->may_show(next_->work.frame.number)) {
    return;
  }
  output_->show();
  if (!next_->work.runs_on) {
    log_.add(next_->work.frame, log_picture_, options_.images ? options_.images() : "");
  }
  next_.reset();
}

void ClusterNodePlayer::follow_light() {
  constexpr double events_every_s = 0.1;
  const double light = node_->light();
  if (std::exchange(light_, light) != light) {
    output_->set_light(light);
    // A frame that was taken but not released must not be seen yet; it will be shown with this light.
    if (!next_) {
      output_->show();
    }
  }
  if (const double now_s = cluster_seconds(); now_s - events_s_ > events_every_s) {
    events_s_ = now_s;
    // Keys do nothing on a node, but windows must handle their events.
    (void)output_->events();
  }
}

void ClusterNodePlayer::fetch() {
  try {
    if (auto offer = node_->take_offer()) {
      const std::filesystem::path folder = content_cache_folder();
      if (folder.empty()) {
        throw Error("files of the master", "cannot be kept without a home folder", "set HOME or XDG_CACHE_HOME");
      }
      cache_.emplace(folder, std::move(*offer));
      print_note("gets {:.1f} MB of files from the master", 1e-6 * static_cast<double>(cache_->missing_bytes()));
    }
    if (!cache_) {
      return;
    }
    for (const ClusterChunk& chunk : node_->take_chunks()) {
      cache_->take(chunk);
    }
    while (const auto wanted = cache_->next(cluster_seconds())) {
      node_->ask_for(*wanted);
    }
    if (!cache_->complete() || !source_.idle()) {
      return;
    }
    std::vector<std::filesystem::path> files = cache_->arrange();
    cache_.reset();
    if (std::exchange(pushed_, files) == files) {
      throw Error("files of the master", "are here, but this node's show still differs", "give both the same options");
    }
    load();
    node_->set_show(options_.identity.show, options_.identity.content);
  } catch (const std::exception& problem) {
    cache_.reset();
    node_->stop_fetching(problem.what());
  }
}

void ClusterNodePlayer::join_swap_group() {
  const bool wanted = node_->group_wanted();
  if (std::exchange(group_asked_, wanted) == wanted) {
    return;
  }
  const std::string problem = output_->join_swap_group(wanted);
  node_->set_grouped(wanted && problem.empty());
  if (!problem.empty()) {
    print_note("{}", problem);
  }
}

}  // namespace ergodome
