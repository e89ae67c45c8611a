#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/cluster/cluster_codec.h"
#include "app/cluster/cluster_master.h"
#include "app/cluster/cluster_node.h"
#include "tests/app/cluster/cluster_frames.h"
#include "tests/app/cluster/fake_network.h"

namespace ergodome {
namespace {

using test::plain_frame;
using testing::HasSubstr;

const ClusterIdentity same_identity = {"0.2.0", "show", "content", "setup"};

//! A master and nodes on a fake network. Nodes render a frame when they are told to.
class ClusterStates : public testing::Test {
 protected:
  struct Computer {
    Computer(test::FakeNetwork& network, const std::string& name, const ClusterIdentity& identity)
        : channel(network, name), node(channel, {name, identity}, [&network] { return network.now_s; }) {}
    test::FakeNetwork::Node channel;
    ClusterNode node;
    std::optional<std::uint64_t> rendered;  //!< number of the last frame
    std::optional<ClusterFrame> frame;      //!< the last one
    std::optional<std::uint64_t> shown;
    bool slow = false;     //!< renders nothing
    bool stopped = false;  //!< does nothing at all
  };

  ClusterStates() { start_master(1); }

  void start_master(std::uint64_t session) {
    master_ = std::make_unique<ClusterMaster>(
        channel_, ClusterMaster::Settings{same_identity, sync_, {"north", "south"}, session},
        [this] { return network_.now_s; });
  }

  Computer& add(const std::string& name, const ClusterIdentity& identity = same_identity) {
    computers_.push_back(std::make_unique<Computer>(network_, name, identity));
    return *computers_.back();
  }

  void run_nodes() {
    for (const auto& each : computers_) {
      if (each->stopped) {
        continue;
      }
      each->node.poll();
      if (each->slow) {
        continue;
      }
      if (const auto work = each->node.take_work(); work && !work->runs_on) {
        each->rendered = work->frame.number;
        each->frame = work->frame;
        each->node.report_ready(work->frame.number, 10.0);
      }
      if (each->rendered && each->node.may_show(*each->rendered)) {
        each->shown = each->rendered;
      }
    }
  }

  //! Lets time pass.
  void pass(double seconds) {
    constexpr double step_s = 0.01;
    for (double passed = 0.0; passed < seconds - 1e-9; passed += step_s) {
      network_.now_s += step_s;
      if (!master_stopped_) {
        master_->poll();
      }
      run_nodes();
    }
  }

  //! Publishes a frame and waits for its release. Returns the time that it took [s].
  double show_frame(const ClusterFrame& frame = plain_frame()) {
    const double begun_s = network_.now_s;
    master_->publish(frame);
    while (!master_->release()) {
      network_.now_s += 0.005;
      run_nodes();
    }
    run_nodes();
    return network_.now_s - begun_s;
  }

  [[nodiscard]] NodeReport report(std::size_t node) const { return master_->nodes()[node]; }

  test::FakeNetwork network_;
  SwapSync sync_ = SwapSync::barrier;
  test::FakeNetwork::Master channel_{network_};
  std::unique_ptr<ClusterMaster> master_;
  bool master_stopped_ = false;
  std::vector<std::unique_ptr<Computer>> computers_;
};

TEST_F(ClusterStates, ShowAFrameWhenAllAreReady) {
  Computer& north = add("north");
  Computer& south = add("south");
  master_->publish(plain_frame());
  EXPECT_TRUE(master_->release()) << "nobody is waited for";
  pass(0.5);
  ASSERT_EQ(report(0).state, NodeState::joined);
  ASSERT_EQ(report(1).state, NodeState::joined);
  south.slow = true;
  const std::uint64_t number = master_->publish(plain_frame());
  EXPECT_FALSE(master_->release());
  run_nodes();
  EXPECT_FALSE(master_->release());
  EXPECT_EQ(north.rendered, number);
  EXPECT_NE(north.shown, number) << "south is not ready";
  south.slow = false;
  run_nodes();
  EXPECT_TRUE(master_->release());
  run_nodes();
  EXPECT_EQ(north.shown, number);
  EXPECT_EQ(south.shown, number);
}

TEST_F(ClusterStates, WithoutSyncShowFramesAtOnce) {
  sync_ = SwapSync::none;
  start_master(1);
  Computer& north = add("north");
  pass(0.5);
  const std::uint64_t number = master_->publish(plain_frame());
  EXPECT_TRUE(master_->release());
  run_nodes();
  EXPECT_EQ(north.shown, number);
}

TEST_F(ClusterStates, GoOnWithoutALateNode) {
  add("north");
  Computer& south = add("south");
  master_->publish(plain_frame());
  (void)master_->release();
  pass(0.5);
  south.slow = true;
  EXPECT_NEAR(show_frame(), 0.1, 0.02) << "a late node is waited for";
  EXPECT_EQ(report(1).state, NodeState::behind);
  EXPECT_EQ(report(1).late_frames, 1);
  EXPECT_LT(show_frame(), 0.02) << "then it runs behind";
  south.slow = false;
  pass(0.1);
  EXPECT_EQ(report(1).state, NodeState::joined);
  EXPECT_EQ(south.shown, south.rendered);
}

TEST_F(ClusterStates, LoseANodeThatRendersNothingAndTakeItBack) {
  add("north");
  Computer& south = add("south");
  master_->publish(plain_frame());
  (void)master_->release();
  pass(0.5);
  south.slow = true;
  for (int i = 0; i < 50; ++i) {
    show_frame();
    pass(0.05);
  }
  EXPECT_EQ(report(1).state, NodeState::lost);
  EXPECT_EQ(report(1).lost, 1);
  EXPECT_EQ(report(0).state, NodeState::joined);
  south.slow = false;
  pass(0.1);
  show_frame();
  pass(0.1);
  EXPECT_EQ(report(1).state, NodeState::joined);
  EXPECT_EQ(report(1).rejoined, 1);
}

TEST_F(ClusterStates, LoseASilentNodeAndTakeItBackWithASnapshot) {
  add("north");
  Computer& south = add("south");
  pass(0.5);
  show_frame();
  pass(0.1);
  network_.cut.insert("south");
  pass(2.1);
  EXPECT_EQ(report(1).state, NodeState::lost);
  show_frame();
  EXPECT_NE(south.shown, computers_[0]->shown);
  network_.cut.clear();
  pass(0.2);
  EXPECT_EQ(report(1).state, NodeState::joined);
  EXPECT_EQ(south.shown, computers_[0]->shown) << "without another frame";
  EXPECT_EQ(report(1).rejoined, 1);
}

TEST_F(ClusterStates, TakeBackANodeThatLostMessages) {
  add("north");
  Computer& south = add("south");
  pass(0.5);
  show_frame();
  pass(0.1);
  network_.deaf.insert("south");
  for (int i = 0; i < 50; ++i) {
    show_frame();
    pass(0.05);
  }
  EXPECT_EQ(report(1).state, NodeState::lost) << "it sends heartbeats but answers no frames";
  network_.deaf.clear();
  pass(0.5);
  EXPECT_EQ(report(1).state, NodeState::joined) << "although it has answered all frames that it got";
  show_frame();
  pass(0.05);
  EXPECT_EQ(south.shown, computers_[0]->shown);
}

TEST_F(ClusterStates, CheckANodeThatWasStartedAgain) {
  add("north");
  add("south");
  pass(0.5);
  show_frame();
  pass(0.1);
  computers_.pop_back();
  pass(2.2);
  ASSERT_EQ(report(1).state, NodeState::lost);
  network_.inject("south", encode_cluster(ClusterHeartbeat{0, 1.0, false}));
  pass(0.1);
  EXPECT_EQ(report(1).state, NodeState::lost) << "its request to join may come later";
  ClusterIdentity other = same_identity;
  other.show = "x";
  add("south", other);
  pass(0.3);
  EXPECT_EQ(report(1).state, NodeState::refused);
}

TEST_F(ClusterStates, AcceptANodeThatWasStartedAgain) {
  add("north");
  add("south");
  pass(0.5);
  show_frame();
  computers_.pop_back();
  Computer& south = add("south");
  pass(0.3);
  EXPECT_EQ(report(1).state, NodeState::joined);
  EXPECT_TRUE(south.shown);
}

TEST_F(ClusterStates, RunOnByTheClockForASecondWithoutAMaster) {
  Computer& north = add("north");
  pass(0.5);
  show_frame(plain_frame(5'000'000'000));
  master_stopped_ = true;
  network_.master_gone = true;
  pass(0.2);
  north.slow = true;
  EXPECT_FALSE(north.node.take_work()) << "heartbeats may be late";
  pass(0.3);
  const auto work = north.node.take_work();
  ASSERT_TRUE(work);
  EXPECT_TRUE(work->runs_on);
  EXPECT_NEAR(1e-9 * static_cast<double>(work->frame.time_ns), 5.5, 0.03);
  pass(0.6);
  EXPECT_FALSE(north.node.take_work());
  bool reported = false;
  for (const ClusterNews& news : north.node.take_news()) {
    reported = reported || news.text.find("master is silent") != std::string::npos;
  }
  EXPECT_TRUE(reported);
}

TEST_F(ClusterStates, HoldAFlightWithoutAMaster) {
  Computer& north = add("north");
  pass(0.5);
  ClusterFrame flight = plain_frame();
  flight.on_path = false;
  show_frame(flight);
  network_.master_gone = true;
  master_stopped_ = true;
  north.slow = true;
  pass(0.5);
  EXPECT_FALSE(north.node.take_work());
}

TEST_F(ClusterStates, JoinAMasterThatWasStartedAgain) {
  Computer& north = add("north");
  pass(0.5);
  for (int i = 0; i < 20; ++i) {
    show_frame();
  }
  network_.master_gone = true;
  master_stopped_ = true;
  pass(3.0);
  network_.master_gone = false;
  master_stopped_ = false;
  start_master(2);
  pass(0.3);
  show_frame();
  pass(0.2);
  EXPECT_EQ(report(0).state, NodeState::joined);
  EXPECT_EQ(north.shown, 1U) << "frames are counted from 1 again";
}

TEST_F(ClusterStates, RefuseOtherVersionsShowsContentsAndSetups) {
  ClusterIdentity other = same_identity;
  other.version = "0.1.0";
  EXPECT_THAT(cluster_difference(same_identity, other), HasSubstr("version 0.1.0 instead of 0.2.0"));
  other = same_identity;
  other.setup = "x";
  EXPECT_THAT(cluster_difference(same_identity, other), HasSubstr("another dome setup"));
  other = same_identity;
  other.content = "x";
  EXPECT_THAT(cluster_difference(same_identity, other), HasSubstr("other contents"));
  other = same_identity;
  other.show = "x";
  EXPECT_THAT(cluster_difference(same_identity, other), HasSubstr("another show"));
  EXPECT_EQ(cluster_difference(same_identity, same_identity), "");

  Computer& north = add("north", other);
  pass(0.5);
  EXPECT_EQ(report(0).state, NodeState::refused);
  EXPECT_THAT(report(0).problem, HasSubstr("another show"));
  EXPECT_EQ(north.node.state(), ClusterNode::State::refused);
  EXPECT_THAT(north.node.take_news().at(0).text, HasSubstr("another show"));
  EXPECT_LT(show_frame(), 0.001) << "nobody waits for it";
  north.node.set_show("show", "content");
  pass(0.3);
  EXPECT_EQ(report(0).state, NodeState::joined);
}

TEST_F(ClusterStates, RefuseNodesThatTheSetupDoesNotName) {
  Computer& west = add("west");
  pass(0.5);
  EXPECT_EQ(west.node.state(), ClusterNode::State::refused);
  EXPECT_THAT(west.node.take_news().at(0).text, HasSubstr("no projector with node = \"west\""));
}

TEST_F(ClusterStates, AskNodesForANewVersionOfTheShow) {
  Computer& north = add("north");
  pass(0.5);
  show_frame();
  master_->set_show("edited", "content");
  const std::optional<std::uint64_t> before = north.rendered;
  master_->publish(plain_frame());
  (void)master_->release();
  pass(0.05);
  EXPECT_TRUE(north.node.show_wanted());
  EXPECT_EQ(north.rendered, before) << "it would render another show";
  north.node.set_show("edited", "content");
  pass(0.3);
  EXPECT_EQ(report(0).state, NodeState::joined);
  EXPECT_NE(north.rendered, before);
}

TEST_F(ClusterStates, SendTheLightOfTheMaster) {
  Computer& north = add("north");
  pass(0.5);
  master_->set_light(0.0);
  run_nodes();
  EXPECT_EQ(north.node.light(), 0.0);
}

TEST_F(ClusterStates, DropAndCountMalformedMessages) {
  add("north");
  pass(0.3);
  for (int i = 0; i < 100; ++i) {
    network_.inject("north", {std::byte{1}, std::byte{2}});
    network_.inject("stranger", std::vector<std::byte>(2000));
  }
  pass(0.1);
  EXPECT_EQ(master_->malformed(), 200);
  EXPECT_EQ(report(0).state, NodeState::joining);
}

TEST_F(ClusterStates, FormASwapGroupWhenAllHaveDrawn) {
  sync_ = SwapSync::nv_swap_group;
  start_master(1);
  Computer& north = add("north");
  Computer& south = add("south");
  pass(0.3);
  show_frame();
  pass(0.1);
  EXPECT_FALSE(north.node.group_wanted()) << "the first frames are irregular";
  for (int i = 0; i < 70; ++i) {
    show_frame();
  }
  pass(0.1);
  EXPECT_TRUE(north.node.group_wanted());
  (void)master_->take_news();
  north.node.set_grouped(true);
  pass(0.1);
  EXPECT_TRUE(master_->take_news().empty());
  south.node.set_grouped(true);
  pass(0.1);
  EXPECT_THAT(master_->take_news().at(0).text, HasSubstr("all nodes have joined the swap group"));
  south.slow = true;
  show_frame();
  pass(0.1);
  EXPECT_EQ(report(1).state, NodeState::behind);
  EXPECT_TRUE(north.node.group_wanted()) << "late nodes stay in the group";
  network_.cut.insert("south");
  pass(2.2);
  EXPECT_FALSE(north.node.group_wanted()) << "swaps would wait for a lost node";
}

TEST_F(ClusterStates, WithoutASwapGroupWantNone) {
  Computer& north = add("north");
  add("south");
  pass(0.3);
  for (int i = 0; i < 70; ++i) {
    show_frame();
  }
  pass(0.1);
  EXPECT_FALSE(north.node.group_wanted());
}

TEST_F(ClusterStates, SendCaptionsToThoseWhoJoinLaterToo) {
  Computer& north = add("north");
  pass(0.3);
  Caption welcome;
  welcome.text = {{"", "Welcome"}};
  master_->set_texts({welcome});
  ClusterFrame frame = plain_frame();
  frame.texts_opacity = 0.5;
  show_frame(frame);
  Computer& south = add("south");
  pass(0.4);
  for (const Computer* const each : {&north, &south}) {
    ASSERT_TRUE(each->frame);
    const std::vector<Caption> captions = each->node.captions_of(*each->frame);
    ASSERT_EQ(captions.size(), 1U);
    EXPECT_EQ(captions[0].text.at(""), "Welcome");
    EXPECT_EQ(each->frame->texts_opacity, 0.5);
  }
  master_->set_texts({});
  show_frame();
  EXPECT_TRUE(north.node.captions_of(*north.frame).empty());
}

TEST_F(ClusterStates, OfferFilesToNodesWithAnotherShow) {
  const ClusterOffer offer{{{"0/show.toml", "0-ab", 5}}, {0}};
  master_->set_offer(offer, [](const ClusterWanted& wanted) {
    return ClusterChunk{wanted.key, wanted.offset, "bytes"};
  });
  ClusterIdentity other = same_identity;
  other.show = "x";
  Computer& north = add("north", other);
  pass(0.3);
  EXPECT_EQ(report(0).state, NodeState::fetching);
  EXPECT_EQ(north.node.state(), ClusterNode::State::fetching);
  ASSERT_EQ(north.node.take_offer()->files.at(0).key, "0-ab");
  EXPECT_LT(show_frame(), 0.001) << "nobody waits for it";
  north.node.ask_for({"0-ab", 0});
  pass(0.1);
  const std::vector<ClusterChunk> chunks = north.node.take_chunks();
  ASSERT_EQ(chunks.size(), 1U);
  EXPECT_EQ(chunks[0].bytes, "bytes");
  north.node.set_show("show", "content");
  pass(0.3);
  show_frame();
  pass(0.1);
  EXPECT_EQ(report(0).state, NodeState::joined);

  other = same_identity;
  other.setup = "x";
  Computer& south = add("south", other);
  pass(0.3);
  EXPECT_EQ(report(1).state, NodeState::refused) << "setups are not sent";
  EXPECT_FALSE(south.node.take_offer());
}

TEST_F(ClusterStates, AskForTheOfferAgainWhenTheMasterWasStartedAgain) {
  const ClusterOffer offer{{{"0/show.toml", "0-ab", 5}}, {0}};
  ClusterIdentity other = same_identity;
  other.show = "x";
  master_->set_offer(offer, {});
  Computer& north = add("north", other);
  pass(0.3);
  ASSERT_TRUE(north.node.take_offer());
  start_master(2);
  master_->set_offer(offer, {});
  pass(1.0);
  EXPECT_TRUE(north.node.take_offer());
}

TEST_F(ClusterStates, SendTheCalibration) {
  Computer& north = add("north");
  pass(0.3);
  master_->set_calibration({0, "[dome]", {GridOffsets()}, {"adjusted"}});
  show_frame();
  ASSERT_TRUE(north.node.calibration());
  EXPECT_EQ(north.frame->calibration, north.node.calibration()->version);
  EXPECT_EQ(north.node.calibration()->texts.at(0), "adjusted");
}

TEST_F(ClusterStates, WithoutAShowOfTheMasterAcceptAnyShow) {
  master_ = std::make_unique<ClusterMaster>(
      channel_, ClusterMaster::Settings{{"0.2.0", "", "", "setup"}, sync_, {"north", "south"}, 1},
      [this] { return network_.now_s; });
  add("north");
  pass(0.3);
  EXPECT_EQ(report(0).state, NodeState::joining);
}

}  // namespace
}  // namespace ergodome
