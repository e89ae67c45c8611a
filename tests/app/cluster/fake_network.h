#pragma once

#include <algorithm>
#include <deque>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "app/cluster/cluster_channel.h"

namespace ergodome::test {

//! A network between a master and its nodes, and the clock of all of them.
class FakeNetwork {
 public:
  double now_s = 100.0;
  std::set<std::string> cut;   //!< peers whose messages get lost
  std::set<std::string> deaf;  //!< peers that get no messages
  bool master_gone = false;    //!< messages from and to the master get lost

  class Master : public MasterChannel {
   public:
    explicit Master(FakeNetwork& network) : network_(network) {}
    void send(const std::string& peer, std::span<const std::byte> bytes) override {
      if (!network_.master_gone && !network_.cut.contains(peer) && !network_.deaf.contains(peer)) {
        network_.to_nodes_[peer].emplace_back(bytes.begin(), bytes.end());
      }
    }
    std::optional<Received> receive() override {
      if (network_.to_master_.empty()) {
        return std::nullopt;
      }
      Received next = network_.to_master_.front();
      network_.to_master_.pop_front();
      return next;
    }

   private:
    FakeNetwork& network_;
  };

  class Node : public NodeChannel {
   public:
    Node(FakeNetwork& network, std::string peer) : network_(network), peer_(std::move(peer)) {}
    void send(std::span<const std::byte> bytes) override {
      if (!network_.master_gone && !network_.cut.contains(peer_)) {
        network_.to_master_.push_back({peer_, {bytes.begin(), bytes.end()}});
      }
    }
    std::optional<std::vector<std::byte>> receive() override {
      auto& messages = network_.to_nodes_[peer_];
      if (messages.empty()) {
        return std::nullopt;
      }
      std::vector<std::byte> next = messages.front();
      messages.pop_front();
      return next;
    }
    void wait(double /*seconds*/) override {}

   private:
    FakeNetwork& network_;
    std::string peer_;
  };

  //! Sends bytes to the master as a peer would.
  void inject(const std::string& peer, std::vector<std::byte> bytes) { to_master_.push_back({peer, std::move(bytes)}); }

 private:
  std::deque<MasterChannel::Received> to_master_;
  std::map<std::string, std::deque<std::vector<std::byte>>> to_nodes_;
};

}  // namespace ergodome::test
