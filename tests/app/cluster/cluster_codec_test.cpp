#include "app/cluster/cluster_codec.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include "tests/app/cluster/cluster_frames.h"

namespace ergodome {
namespace {

using test::full_frame;
using test::plain_frame;

std::vector<ClusterMessage> one_of_each_kind() {
  return {full_frame(),
          plain_frame(),
          ClusterHello{"north", {"0.2.0", "aa", "bb", "cc"}},
          ClusterWelcome{42, SwapSync::nv_swap_group},
          ClusterRefused{"another show"},
          ClusterReady{17, 12.5},
          ClusterSwap{18},
          ClusterHeartbeat{42, 0.5, true},
          test::some_texts(),
          test::some_calibration(),
          ClusterOffer{{{"0/show.toml", "0-ab12", 5}, {"0/sky.exr", "1073741825-cd34", 1'073'741'825}}, {0}},
          ClusterWanted{"0-ab12", 17},
          ClusterChunk{"0-ab12", 17, std::string("\0\1x", 3)}};
}

TEST(ClusterMessages, SurviveARoundTrip) {
  for (const ClusterMessage& message : one_of_each_kind()) {
    const std::vector<std::byte> bytes = encode_cluster(message);
    const auto read = decode_cluster(bytes);
    ASSERT_TRUE(read) << message.index();
    EXPECT_EQ(read->index(), message.index());
    EXPECT_EQ(encode_cluster(*read), bytes);
  }
}

TEST(ClusterMessages, KeepEveryMemberOfAFrame) {
  const ClusterFrame sent = full_frame();
  const auto read = decode_cluster(encode_cluster(sent));
  ASSERT_TRUE(read);
  const auto& frame = std::get<ClusterFrame>(*read);
  EXPECT_EQ(frame.number, sent.number);
  EXPECT_EQ(frame.epoch, sent.epoch);
  EXPECT_EQ(frame.time_ns, sent.time_ns);
  EXPECT_EQ(frame.rate, sent.rate);
  EXPECT_EQ(frame.pose.r, sent.pose.r);
  EXPECT_EQ(frame.pose.theta, sent.pose.theta);
  EXPECT_EQ(frame.pose.phi, sent.pose.phi);
  EXPECT_EQ(frame.pose.orientation, sent.pose.orientation);
  EXPECT_EQ(frame.pose.velocity->y, -0.2);
  EXPECT_TRUE(frame.pose.velocity_in_rain);
  EXPECT_EQ(frame.pose.clock_lead, -17.5);
  EXPECT_EQ(frame.before->r, 12.5);
  EXPECT_EQ(frame.before->theta, 1.25);
  EXPECT_EQ(frame.motion, sent.motion);
  EXPECT_EQ(frame.velocity.z, -0.125);
  EXPECT_EQ(frame.mode, sent.mode);
  EXPECT_EQ(frame.stereo, sent.stereo);
  EXPECT_EQ(frame.exposure_stops, -2.5);
  EXPECT_EQ(frame.followed_stops, 1.25);
  EXPECT_EQ(frame.language, sent.language);
  EXPECT_FALSE(frame.captions);
  EXPECT_EQ(frame.size_px, 4096);
  EXPECT_EQ(frame.projectors_px, 5000);
  EXPECT_EQ(frame.quality, sent.quality);
  EXPECT_TRUE(frame.attract);
  EXPECT_EQ(frame.texts_opacity, 0.75);
  EXPECT_EQ(frame.texts, 3U);
  EXPECT_EQ(frame.pattern, ClusterPattern::test_pattern);
  EXPECT_EQ(frame.pattern_kind, 4);
  EXPECT_EQ(frame.calibration, 5U);
}

TEST(ClusterMessages, KeepCaptionsAndCalibrations) {
  const ClusterTexts texts = test::some_texts();
  const auto captions = std::get<ClusterTexts>(*decode_cluster(encode_cluster(texts))).captions;
  ASSERT_EQ(captions.size(), 2U);
  EXPECT_EQ(captions[0].text, texts.captions[0].text);
  EXPECT_EQ(captions[0].position, texts.captions[0].position);
  EXPECT_EQ(captions[0].color, texts.captions[0].color);
  const ClusterCalibration sent = test::some_calibration();
  const auto read = std::get<ClusterCalibration>(*decode_cluster(encode_cluster(sent)));
  EXPECT_EQ(read.setup, sent.setup);
  EXPECT_EQ(read.offsets, sent.offsets);
  EXPECT_EQ(read.texts, sent.texts);
  ClusterCalibration far = sent;
  far.offsets[1].right[4] = 0.5;
  EXPECT_FALSE(decode_cluster(encode_cluster(far)));
  far = sent;
  far.offsets[1].points = 4;
  EXPECT_FALSE(decode_cluster(encode_cluster(far)));
}

TEST(ClusterMessages, FitIntoAKilobyte) {
  EXPECT_LE(encode_cluster(full_frame()).size(), 512U);
  const ClusterRefused longest{std::string(5000, 'x')};
  const std::vector<std::byte> bytes = encode_cluster(longest);
  EXPECT_LE(bytes.size(), max_cluster_message);
  EXPECT_EQ(std::get<ClusterRefused>(*decode_cluster(bytes)).reason.size(), max_cluster_reason);
}

TEST(ClusterMessages, AreRefusedIfBytesAreMissingOrLeft) {
  for (const ClusterMessage& message : one_of_each_kind()) {
    std::vector<std::byte> bytes = encode_cluster(message);
    for (std::size_t size = 0; size < bytes.size(); ++size) {
      EXPECT_FALSE(decode_cluster(std::span(bytes).first(size))) << message.index() << ", " << size;
    }
    bytes.push_back(std::byte{0});
    EXPECT_FALSE(decode_cluster(bytes)) << message.index();
  }
}

TEST(ClusterMessages, OfAnotherVersionOrKindAreRefused) {
  std::vector<std::byte> bytes = encode_cluster(ClusterSwap{1});
  bytes[2] = std::byte{cluster_format + 1};
  EXPECT_FALSE(decode_cluster(bytes));
  bytes = encode_cluster(ClusterSwap{1});
  bytes[3] = std::byte{200};
  EXPECT_FALSE(decode_cluster(bytes));
}

TEST(ClusterMessages, WithImpossibleValuesAreRefused) {
  const auto refused = [](auto change) {
    ClusterFrame frame = plain_frame();
    change(frame);
    return !decode_cluster(encode_cluster(frame));
  };
  EXPECT_FALSE(refused([](ClusterFrame&) {}));
  EXPECT_TRUE(refused([](ClusterFrame& frame) { frame.pose.r = std::nan(""); }));
  EXPECT_TRUE(refused([](ClusterFrame& frame) { frame.pose.r = std::numeric_limits<double>::infinity(); }));
  EXPECT_TRUE(refused([](ClusterFrame& frame) { frame.pose.r = -1.0; }));
  EXPECT_TRUE(refused([](ClusterFrame& frame) { frame.pose.orientation.w = 0.5; }));
  EXPECT_TRUE(refused([](ClusterFrame& frame) { frame.velocity = {0.9, 0.9, 0.0}; }));
  EXPECT_TRUE(refused([](ClusterFrame& frame) { frame.size_px = -1; }));
  EXPECT_TRUE(refused([](ClusterFrame& frame) { frame.size_px = 1'000'000; }));
  EXPECT_TRUE(refused([](ClusterFrame& frame) { frame.mode = static_cast<ViewMode>(77); }));
  EXPECT_TRUE(refused([](ClusterFrame& frame) { frame.language = "\x1b[2J"; }));
  EXPECT_TRUE(refused([](ClusterFrame& frame) { frame.followed_stops = std::nan(""); }));
}

TEST(ClusterMessages, OfRandomBytesAreRefusedOrValid) {
  std::mt19937 random(5);
  for (int i = 0; i < 20'000; ++i) {
    std::vector<std::byte> bytes = encode_cluster(full_frame());
    for (int k = 0; k < 3; ++k) {
      bytes[4 + random() % (bytes.size() - 4)] = static_cast<std::byte>(random());
    }
    if (const auto read = decode_cluster(bytes)) {
      const auto& frame = std::get<ClusterFrame>(*read);
      EXPECT_TRUE(std::isfinite(frame.pose.r) && std::isfinite(frame.stereo.baseline));
      EXPECT_EQ(encode_cluster(*read), bytes);
    }
  }
}

}  // namespace
}  // namespace ergodome
