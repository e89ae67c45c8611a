#include "app/commands/farm/frame_chunks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>

namespace ergodome {
namespace {

using testing::ElementsAre;

std::vector<std::string> texts_of(const std::vector<FrameChunk>& chunks) {
  std::vector<std::string> texts;
  std::ranges::transform(chunks, std::back_inserter(texts), text_of);
  return texts;
}

TEST(FrameChunks, TakeAboutTwoMinutes) {
  EXPECT_EQ(chunk_size(1.0, 1.0, 18'000), 120);
  EXPECT_EQ(chunk_size(30.0, 1.0, 100), 4);
  EXPECT_EQ(chunk_size(500.0, 1.0, 100), 1);
}

TEST(FrameChunks, TakeTenTimesAsLongAsAStart) { EXPECT_EQ(chunk_size(10.0, 30.0, 1000), 30); }

TEST(FrameChunks, HaveAtMostAllFrames) {
  EXPECT_EQ(chunk_size(0.0, 0.0, 60), 60);
  EXPECT_EQ(chunk_size(1e-9, 0.0, 1), 1);
}

TEST(FrameChunks, AreFewEnoughForAnArrayOfSlurm) { EXPECT_EQ(chunk_size(60.0, 1.0, 36'000), 36); }

TEST(FrameChunks, CoverAFilm) {
  EXPECT_THAT(texts_of(chunks_of({0, 24}, 10, all_frames({0, 24}))), ElementsAre("1:10", "11:20", "21:25"));
  EXPECT_THAT(texts_of(chunks_of({99, 99}, 10, all_frames({99, 99}))), ElementsAre("100:100"));
}

TEST(FrameChunks, AreCutToFramesThatLack) {
  EXPECT_THAT(texts_of(chunks_of({0, 59}, 10, {3, 5, 29, 30})), ElementsAre("4:6", "30:30", "31:31"));
  EXPECT_THAT(texts_of(chunks_of({0, 59}, 10, {})), ElementsAre());
}

TEST(FrameChunks, OfOpenJobDescriptionBeginWithEachGap) {
  EXPECT_THAT(texts_of(runs_of(3, {0, 1, 2, 3, 7, 8, 9, 10, 20})), ElementsAre("1:3", "4:4", "8:10", "11:11", "21:21"));
}

}  // namespace
}  // namespace ergodome
