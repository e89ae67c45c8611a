#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/cluster/cluster_master.h"
#include "app/playback/transport.h"
#include "app/player/frame_log.h"
#include "app/player/renderers/picture_gate.h"
#include "calibration/dome/dome_setup.h"

namespace ergodome {

//! A master of the nodes of a dome, and the connections to them.
struct ClusterHost {
  std::unique_ptr<MasterChannel> channel;
  std::unique_ptr<ClusterMaster> master;
};

//! Listens for the nodes of a setup, which must have a [cluster]. Nodes may have any show until the
//! master has one. Throws Error if the keys cannot be read or the address cannot be used.
ClusterHost open_cluster(const DomeSetup& setup);

//! Shows the pictures of the player at the same time as the nodes of a dome: the player is the
//! master.
class ClusterGate : public PictureGate {
 public:
  //! Listens for the nodes of a setup, which must have a [cluster]. `projectors_px`: width
  //! of the domemaster that all projectors need (OutputWish). `frame_log`: file for FrameLog; may be
  //! empty. Throws Error if the keys cannot be read or the address cannot be used.
  ClusterGate(const DomeSetup& setup, int projectors_px, const std::string& frame_log);

  //! Sends files of the shows to nodes that lack them.
  void push_content() { pushes_ = true; }

  //! Continues with these versions of the shows: that of the command line and, in an exhibit, the
  //! attract show. Throws Error if files that must be sent cannot be.
  void set_shows(const std::vector<Show>& shows);
  //! Chooses which of both shows the next pictures are of.
  void set_attract(bool attract);

  //! Handles messages; called once per frame. `rate`: change of show time per second while the
  //! camera is on the show's path, otherwise 0. `light`: factor on the displays' light.
  void advance(double rate, double light);

  void publish(PictureRequest& request) override;
  bool release(PictureAnswer& answer) override;

  //! Returns the lines for the log since the last call.
  [[nodiscard]] std::vector<ClusterNews> take_news() { return host_.master->take_news(); }
  //! Returns whether the display must be in the swap group of the nodes.
  [[nodiscard]] bool group_wanted() const { return host_.master->group_wanted(); }
  //! Adds the state of the nodes.
  void fill(PlayerStatus& status) const;

 private:
  ClusterHost host_;
  ClusterFrame frame_;  //!< last frame
  bool attract_ = false;
  bool pushes_ = false;
  std::optional<double> finished_s_;  //!< when the picture that waits was finished
  std::optional<double> stops_;       //!< that automatic exposure chose for the last picture
  FrameLog log_;
  int projectors_px_;
  double rate_ = 0.0;
};

//! Returns the identity of a computer in a cluster, without that of the show.
ClusterIdentity cluster_identity(const DomeSetup& setup);

//! Returns the file of keys that a setup names. Throws Error if the setup has no [cluster].
std::filesystem::path cluster_key_file(const DomeSetup& setup, const std::string& name);

//! Returns the time of the steady clock [s].
double cluster_seconds();

}  // namespace ergodome
