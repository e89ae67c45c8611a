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

//! Shows the pictures of the player at the same time as the nodes of a dome: the player is the
//! master.
class ClusterGate : public PictureGate {
 public:
  //! Listens for the nodes of a setup, which must have a [cluster]. `projectors_px`: width
  //! of the domemaster that all projectors need (OutputWish). `frame_log`: file for FrameLog; may be
  //! empty. Throws Error if the keys cannot be read or the address cannot be used.
  ClusterGate(const DomeSetup& setup, int projectors_px, const std::string& frame_log);

  //! Continues with another version of the show, or with the first one.
  void set_show(const Show& show);

  //! Handles messages; called once per frame. `rate`: change of show time per second while the
  //! camera is on the show's path, otherwise 0. `light`: factor on the displays' light.
  void advance(double rate, double light);

  void publish(PictureRequest& request) override;
  bool release(PictureAnswer& answer) override;

  //! Returns the lines for the log since the last call.
  [[nodiscard]] std::vector<ClusterNews> take_news() { return master_->take_news(); }
  //! Adds the state of the nodes.
  void fill(PlayerStatus& status) const;

 private:
  std::unique_ptr<MasterChannel> channel_;
  std::optional<ClusterMaster> master_;
  ClusterFrame frame_;  //!< last frame
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
