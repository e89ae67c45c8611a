#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/cluster/cluster_library.h"
#include "app/cluster/cluster_node.h"
#include "app/playback/show_reload.h"
#include "app/player/frame_log.h"
#include "app/player/renderers/frame_source.h"
#include "app/player/renderers/renderer_loader.h"
#include "calibration/projectors/projector_picture.h"
#include "render/present/output.h"

namespace ergodome {

//! Options of `node`.
struct NodeOptions {
  std::string name;  //!< name of this computer in the setup
  std::string host;  //!< of the master
  int port = 0;
  ClusterKeys keys;
  ClusterIdentity identity;    //!< without the show
  std::string frame_log;       //!< file for FrameLog; empty: none
  std::function<Show()> load;  //!< reads the show and fits it to the setup
};

//! Renders the frames that the master of a dome sends, and shows them together with the others.
class ClusterNodePlayer {
 public:
  //! `output` may be a DomeOutput or one without windows. Throws Error if the master's address is
  //! invalid or the show cannot be read or rendered.
  ClusterNodePlayer(const NodeOptions& options, RendererLoader::Make make, std::unique_ptr<DisplayOutput> output);
  ~ClusterNodePlayer();
  ClusterNodePlayer(const ClusterNodePlayer&) = delete;
  ClusterNodePlayer& operator=(const ClusterNodePlayer&) = delete;

  //! Runs until the output is closed or the program is interrupted.
  void run();

 private:
  void start_next();
  void show_released();
  void reload_show();
  void report();
  void load();

  struct Shown {
    ClusterNode::Work work;
    std::optional<PictureAnswer> answer;  //!< absent while it is rendered
  };

  NodeOptions options_;
  RendererLoader::Make make_;
  std::unique_ptr<DisplayOutput> output_;
  Show show_;
  std::shared_ptr<ShowRenderer> renderer_;
  FileWatch files_;
  std::unique_ptr<NodeChannel> channel_;
  std::optional<ClusterNode> node_;
  FrameSource source_;
  std::optional<Shown> next_;  //!< frame that is rendered or waits for its release
  FrameLog log_;
  Picture log_picture_;  //!< picture of `next_`, for the log
  double light_ = 1.0;
  double events_s_ = 0.0;
};

//! An output without windows, which draws the projectors' pictures into memory.
std::unique_ptr<DisplayOutput> output_without_windows(const std::vector<ProjectorPicture>& pictures);

}  // namespace ergodome
