#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/cluster/cluster_library.h"
#include "app/cluster/cluster_node.h"
#include "app/playback/show_reload.h"
#include "app/player/content_push.h"
#include "app/player/frame_log.h"
#include "app/player/node_calibration.h"
#include "app/player/renderers/frame_source.h"
#include "app/player/renderers/renderer_loader.h"
#include "render/present/output.h"

namespace ergodome {

//! Options of `node`.
struct NodeOptions {
  std::string name;  //!< name of this computer in the setup
  std::string host;  //!< of the master
  int port = 0;
  ClusterKeys keys;
  ClusterIdentity identity;  //!< without the show
  std::string frame_log;     //!< file for FrameLog; empty: none
  //! Returns the fingerprint of the projectors' images, for the log; may be empty.
  std::function<std::string()> images;
  DomeSetup setup;  //!< with the projectors of all computers
  //! Reads shows and fits them to the setup: these files, or without any those of the command line
  //! (the show and, in an exhibit, the attract show, or none).
  std::function<std::vector<Show>(const std::vector<std::filesystem::path>&)> load;
};

//! Renders the frames that the master of a dome sends, and shows them together with the others.
class ClusterNodePlayer {
 public:
  //! `output`: the projectors of this node. Throws Error if the master's address is
  //! invalid or the show cannot be read or rendered.
  ClusterNodePlayer(const NodeOptions& options, RendererLoader::Make make, std::unique_ptr<DisplayOutput> output);
  ~ClusterNodePlayer();
  ClusterNodePlayer(const ClusterNodePlayer&) = delete;
  ClusterNodePlayer& operator=(const ClusterNodePlayer&) = delete;

  //! Runs until the output is closed or the program is interrupted.
  void run();

 private:
  void start_next();
  void take_answer();
  void show_released();
  void follow_light();
  void show_calibration(const ClusterFrame& frame);
  void reload_show();
  void report();
  void load();
  void join_swap_group();
  void fetch();

  struct Shown {
    ClusterNode::Work work;
    std::optional<PictureAnswer> answer;  //!< absent while it is rendered
  };

  NodeOptions options_;
  RendererLoader::Make make_;
  std::unique_ptr<DisplayOutput> output_;
  std::vector<Show> shows_;
  std::vector<std::shared_ptr<ShowRenderer>> renderers_;  //!< of `shows_`
  NodeCalibration calibration_;
  std::vector<std::filesystem::path> pushed_;  //!< shows from the master, which replace those of the command line
  std::optional<ContentCache> cache_;          //!< while files come from the master
  FileWatch files_;
  bool files_changed_ = false;  //!< since the last load()
  std::unique_ptr<NodeChannel> channel_;
  std::optional<ClusterNode> node_;
  FrameSource source_;
  std::optional<Shown> next_;  //!< frame that is rendered or waits for its release
  FrameLog log_;
  Picture log_picture_;  //!< picture of `next_`, for the log
  double light_ = 1.0;
  double events_s_ = 0.0;
  std::vector<std::string> shown_texts_;  //!< on the projectors
  bool group_asked_ = false;              //!< the last request to the output to be in the swap group
};

}  // namespace ergodome
