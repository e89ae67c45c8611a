#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/cluster/cluster_channel.h"
#include "app/cluster/cluster_messages.h"

namespace ergodome {

//! State of a node, for operators.
enum class NodeState {
  absent,    //!< was never heard
  refused,   //!< has another version, show, content or setup
  fetching,  //!< gets the files of the show
  joining,   //!< has not yet rendered its first frame
  joined,    //!< is waited for
  behind,    //!< was late, shows frames when it has them, and is not waited for
  lost       //!< is silent, or has rendered nothing for two seconds
};

struct NodeReport {
  std::string name;
  NodeState state = NodeState::absent;
  double frame_ms = 0.0;  //!< usual time in which the node renders a frame
  long late_frames = 0;
  long lost = 0;        //!< how often it was lost
  long rejoined = 0;    //!< how often it came back
  std::string problem;  //!< why it is refused; otherwise empty
};

//! The master of a dome of several computers: sends frames to the nodes and releases each frame
//! when all nodes are ready. Without sockets and threads.
//!
//! A node that takes much longer than usual is no longer waited for until it is ready in time again.
//! After two seconds without an answer it is lost. It rejoins by itself with the last frame.
class ClusterMaster {
 public:
  struct Settings {
    ClusterIdentity identity;  //!< if it has no show, nodes may have any show
    SwapSync sync = SwapSync::barrier;
    std::vector<std::string> nodes;  //!< names of the nodes in the setup; others are refused
    std::uint64_t session = 0;       //!< number of this run; different in each run, not 0
  };

  //! The channel must outlive this.
  ClusterMaster(MasterChannel& channel, Settings settings, ClusterClock clock);

  //! Handles messages, sends heartbeats and notices lost nodes. Call it often.
  void poll();

  //! Numbers a frame and sends it to all nodes that have joined. Returns the number.
  std::uint64_t publish(ClusterFrame frame);

  //! Returns whether the last frame may be shown, and tells the nodes to show it.
  [[nodiscard]] bool release();

  //! Returns the time of the slowest node that was waited for in the last released frame [ms]; 0
  //! without nodes.
  [[nodiscard]] double slowest_ms() const { return slowest_ms_; }

  //! Sets the factor on the light of all displays.
  void set_light(double light);

  //! Sets the captions of the next frames that are not part of the show, without times.
  void set_texts(std::vector<Caption> captions);
  //! Sets the state of the dome's calibration for the next frames. The version is chosen here.
  void set_calibration(ClusterCalibration calibration);

  //! Offers the files of the show to nodes that have another show or other contents. `read` returns
  //! the bytes that a node asks for, or nothing.
  using ReadContent = std::function<std::optional<ClusterChunk>(const ClusterWanted&)>;
  void set_offer(std::optional<ClusterOffer> offer, ReadContent read);

  //! Continues with another version of the show. Nodes must prove that they have it too.
  void set_show(const std::string& show, const std::string& content);

  [[nodiscard]] std::vector<NodeReport> nodes() const;
  //! Returns whether computers must be in the swap group: with SwapSync::nv_swap_group, when every
  //! node of the setup has rendered some frames, and until one of them is lost.
  [[nodiscard]] bool group_wanted() const { return group_; }

  //! Returns the number of messages that were dropped because they were malformed.
  [[nodiscard]] long malformed() const { return malformed_; }
  //! Returns the lines for the log since the last call.
  [[nodiscard]] std::vector<ClusterNews> take_news();

 private:
  struct Node {
    NodeReport report;
    std::string peer;
    double heard_s = 0.0;
    double asked_s = 0.0;     //!< when the first frame that it has not answered was sent
    bool awaited = false;     //!< the last frame waits for it
    bool owes = false;        //!< it has not answered the last frame that it got
    bool silent = false;      //!< is lost because nothing was heard
    bool grouped = false;     //!< has joined the swap group
    long frames = 0;          //!< frames rendered since it joined
    std::uint64_t ready = 0;  //!< last frame that it was ready for
  };

  void take(const MasterChannel::Received& received);
  //! Returns whether a node with another show can get the master's.
  [[nodiscard]] bool may_fetch(const ClusterIdentity& identity) const;
  void greet(const ClusterHello& hello, const std::string& peer);
  void note_ready(Node& node, const ClusterReady& ready);
  void welcome(Node& node);
  void form_group();
  //! Sends the last frame to a lost node that is heard.
  void probe(Node& node);
  void lose(Node& node, bool silent, const std::string& why);
  void rejoin(Node& node);
  void send(const std::string& peer, const ClusterMessage& message);
  void send_to_all(const ClusterMessage& message);
  void beat();
  [[nodiscard]] double patience_s(const Node& node) const;
  [[nodiscard]] Node* node_of(const std::string& peer);
  //! Returns whether frames are sent to a node.
  [[nodiscard]] static bool takes_part(const Node& node);

  MasterChannel& channel_;
  Settings settings_;
  ClusterClock clock_;
  std::map<std::string, Node> nodes_;  //!< by name
  std::optional<ClusterFrame> frame_;  //!< last frame
  std::optional<ClusterOffer> offer_;
  ReadContent read_content_;
  std::optional<ClusterTexts> texts_;
  std::optional<ClusterCalibration> calibration_;
  std::uint64_t number_ = 0;
  std::uint32_t epoch_ = 1;
  double published_s_ = 0.0;
  double beat_s_ = -1e9;
  bool released_ = true;
  double slowest_ms_ = 0.0;
  double light_ = 1.0;
  bool group_ = false;
  bool group_formed_ = false;  //!< all nodes have joined the swap group
  long malformed_ = 0;
  std::vector<ClusterNews> news_;
};

//! Returns the difference between two computers for a message, such as "it has another show"; empty
//! if there is none. `there`: of the node that is named in the message.
std::string cluster_difference(const ClusterIdentity& here, const ClusterIdentity& there);

//! Returns the name of a state, for operators: "joined".
const char* node_state_name(NodeState state);

}  // namespace ergodome
