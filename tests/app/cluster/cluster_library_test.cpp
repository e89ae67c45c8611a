#include "app/cluster/cluster_library.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <functional>

#include "app/cluster/cluster_codec.h"
#include "tests/support/errors.h"
#include "tests/support/folder_test.h"

namespace ergodome {
namespace {

using testing::HasSubstr;

ClusterKeys new_keys() {
  ClusterKeys keys;
  std::string problem;
  EXPECT_TRUE(cluster_library().make_keys(keys, problem)) << problem;
  return keys;
}

//! Listens on a free port of the loopback interface.
struct Listener {
  explicit Listener(const ClusterKeys& keys) {
    std::string problem;
    for (port = 27'653; port < 27'753 && !channel; ++port) {
      channel = cluster_library().listen("127.0.0.1", port, keys, problem);
    }
    --port;
  }
  std::unique_ptr<MasterChannel> channel;
  int port = 0;
};

//! Calls `poll` until it returns a value; at most two seconds.
template <class Value>
std::optional<Value> wait_for(const std::function<std::optional<Value>()>& poll) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(2);
  std::optional<Value> value = poll();
  while (!value && std::chrono::steady_clock::now() < end) {
    value = poll();
  }
  return value;
}

std::optional<MasterChannel::Received> received_by(MasterChannel& master, NodeChannel& node,
                                                   const ClusterMessage& message) {
  return wait_for<MasterChannel::Received>([&] {
    node.send(encode_cluster(message));
    node.wait(0.01);
    return master.receive();
  });
}

TEST(ClusterLibrary, CarriesMessagesBothWays) {
  const ClusterKeys keys = new_keys();
  const Listener master(keys);
  ASSERT_TRUE(master.channel);
  std::string problem;
  const auto node = cluster_library().connect("127.0.0.1", master.port, keys, "north", problem);
  ASSERT_TRUE(node) << problem;
  const auto received = received_by(*master.channel, *node, ClusterReady{7, 1.0});
  ASSERT_TRUE(received);
  EXPECT_EQ(received->peer, "north");
  EXPECT_EQ(received->bytes, encode_cluster(ClusterReady{7, 1.0}));
  const std::vector<std::byte> answer = encode_cluster(ClusterSwap{7});
  const auto bytes = wait_for<std::vector<std::byte>>([&] {
    master.channel->send("north", answer);
    node->wait(0.01);
    return node->receive();
  });
  EXPECT_EQ(bytes, answer);
}

TEST(ClusterLibrary, LetsNoPeerInWithoutTheKeys) {
  const ClusterKeys keys = new_keys();
  const Listener master(keys);
  ASSERT_TRUE(master.channel);
  ClusterKeys stolen = new_keys();
  stolen.master_public = keys.master_public;
  std::string problem;
  const auto node = cluster_library().connect("127.0.0.1", master.port, stolen, "north", problem);
  EXPECT_FALSE(received_by(*master.channel, *node, ClusterReady{7, 1.0}));
}

TEST(ClusterLibrary, NamesWhyItCannotListen) {
  const ClusterKeys keys = new_keys();
  const Listener master(keys);
  std::string problem;
  EXPECT_FALSE(cluster_library().listen("127.0.0.1", master.port, keys, problem));
  EXPECT_THAT(problem, HasSubstr("in use"));
  EXPECT_FALSE(cluster_library().listen("nothere0", master.port, keys, problem));
  EXPECT_THAT(problem, HasSubstr("No such device"));
}

class ClusterKeyFiles : public test::FolderTest {};

TEST_F(ClusterKeyFiles, AreReadAsTheyWereWritten) {
  const ClusterKeys keys = new_keys();
  const std::filesystem::path file = folder_ / "dome.key";
  write_cluster_keys(file, keys);
  const ClusterKeys read = read_cluster_keys(file);
  EXPECT_EQ(read.master_secret, keys.master_secret);
  EXPECT_EQ(read.node_public, keys.node_public);
  EXPECT_THAT(test::error_of([&] { write_cluster_keys(file, keys); }), HasSubstr("exists"));
}

TEST_F(ClusterKeyFiles, AreRefusedIfOthersCanReadThem) {
  const std::filesystem::path file = folder_ / "dome.key";
  write_cluster_keys(file, new_keys());
  std::filesystem::permissions(file, std::filesystem::perms(0644));
  EXPECT_THAT(test::error_of([&] { read_cluster_keys(file); }), HasSubstr("chmod 600"));
}

TEST_F(ClusterKeyFiles, AreRefusedIfMalformed) {
  const std::filesystem::path file = folder_ / "dome.key";
  std::ofstream(file) << "master_public = \"short\"\n";
  std::filesystem::permissions(file, std::filesystem::perms(0600));
  EXPECT_THAT(test::error_of([&] { read_cluster_keys(file); }), HasSubstr("not a key"));
  EXPECT_THAT(test::error_of([&] { read_cluster_keys(folder_ / "missing.key"); }), HasSubstr("--make-key"));
}

}  // namespace
}  // namespace ergodome
