#include "app/player/content_push.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "app/cli/show_loading.h"
#include "app/cluster/cluster_codec.h"
#include "app/player/cluster_frames.h"
#include "kernels/core/error.h"
#include "tests/support/folder_test.h"

namespace ergodome {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class ContentPush : public test::FolderTest {
 protected:
  [[nodiscard]] Show show_with(const std::string& map) const {
    fs::create_directories(folder_ / "shows" / "mine");
    fs::create_directories(folder_ / "skies");
    std::ofstream(folder_ / "skies" / "sky.ppm", std::ios::binary) << "P6 200 200 255\n" << std::string(120'000, 'a');
    std::ofstream(folder_ / "shows" / "mine" / "first.toml")
        << "title = \"T\"\n[[camera.key]]\nr = 20\n[sky]\nmap = \"" << map << "\"\n";
    return load_show((folder_ / "shows" / "mine" / "first.toml").string(), {"hole.spin=0.5"});
  }

  //! Sends what a node asks for until it has all files.
  static void send_all(const ContentSource& source, ContentCache& cache) {
    double now_s = 0.0;
    for (int i = 0; i < 1000 && !cache.complete(); ++i) {
      now_s += 0.01;
      while (const auto wanted = cache.next(now_s)) {
        const auto chunk = source.read(*wanted);
        ASSERT_TRUE(chunk);
        cache.take(std::get<ClusterChunk>(*decode_cluster(encode_cluster(*chunk))));
      }
    }
  }
};

TEST_F(ContentPush, GivesANodeTheSameShow) {
  const Show show = show_with("../../skies/sky.ppm");
  const ContentSource source({show});
  const auto offer = std::get<ClusterOffer>(*decode_cluster(encode_cluster(source.offer())));
  ASSERT_EQ(offer.files.size(), 2U);
  ContentCache cache(folder_ / "cache", offer);
  EXPECT_GT(cache.missing_bytes(), 120'000U);
  send_all(source, cache);
  ASSERT_TRUE(cache.complete());
  const std::vector<fs::path> files = cache.arrange();
  ASSERT_EQ(files.size(), 1U);
  const Show there = load_show(files[0].string());
  EXPECT_EQ(fingerprint_of_shows({there}), fingerprint_of_shows({show}));
  EXPECT_EQ(fingerprint_of_contents({there}), fingerprint_of_contents({show}));

  const ContentCache again(folder_ / "cache", offer);
  EXPECT_TRUE(again.complete()) << "the files are kept";
  EXPECT_EQ(again.arrange(), files);
}

TEST_F(ContentPush, AsksAgainForLostBytes) {
  const ContentSource source({show_with("../../skies/sky.ppm")});
  ContentCache cache(folder_ / "cache", source.offer());
  while (cache.next(0.0)) {
    // The answers get lost.
  }
  EXPECT_FALSE(cache.next(0.5));
  EXPECT_TRUE(cache.next(1.5));
  ContentCache other(folder_ / "cache", source.offer());
  send_all(source, other);
  EXPECT_TRUE(other.complete());
}

TEST_F(ContentPush, ServesTwoNodesThatShareAFolder) {
  const ContentSource source({show_with("../../skies/sky.ppm")});
  ContentCache first(folder_ / "cache", source.offer());
  ContentCache second(folder_ / "cache", source.offer());
  double now_s = 0.0;
  for (int i = 0; i < 1000 && !(first.complete() && second.complete()); ++i) {
    now_s += 0.01;
    for (ContentCache* const cache : {&first, &second}) {
      if (const auto wanted = cache->next(now_s)) {
        cache->take(*source.read(*wanted));
      }
    }
  }
  ASSERT_TRUE(first.complete() && second.complete());
  EXPECT_EQ(first.arrange(), second.arrange());
  for (const ClusterOffer::File& file : source.offer().files) {
    EXPECT_EQ(content_key(folder_ / "cache" / file.key), file.key);
  }
}

TEST_F(ContentPush, GetsADamagedFileOfItsFolderAgain) {
  const ContentSource source({show_with("../../skies/sky.ppm")});
  ContentCache cache(folder_ / "cache", source.offer());
  send_all(source, cache);
  const std::vector<fs::path> shows = cache.arrange();
  fs::resize_file(shows.front(), 5);
  ContentCache again(folder_ / "cache", source.offer());
  EXPECT_FALSE(again.complete());
  send_all(source, again);
  EXPECT_EQ(content_key(again.arrange().front()), source.offer().files.front().key);
}

TEST_F(ContentPush, RefusesDamagedFiles) {
  const ContentSource source({show_with("../../skies/sky.ppm")});
  ContentCache cache(folder_ / "cache", source.offer());
  const auto wanted = cache.next(0.0);
  ASSERT_TRUE(wanted);
  auto chunk = source.read(*wanted);
  chunk->bytes[0] ^= 1;
  try {
    cache.take(*chunk);
    FAIL();
  } catch (const Error& problem) {
    EXPECT_THAT(problem.what(), HasSubstr("was damaged on its way"));
  }
}

TEST_F(ContentPush, WritesNothingOutsideItsFolder) {
  for (const char* const name : {"../evil", "/etc/evil", "a/../../evil", ""}) {
    EXPECT_THROW(ContentCache(folder_ / "cache", ClusterOffer{{{name, "0-ab", 1}}, {0}}), Error) << name;
  }
  EXPECT_FALSE(decode_cluster(encode_cluster(ClusterOffer{{{"show.toml", "../ab", 1}}, {0}})));
  EXPECT_FALSE(decode_cluster(encode_cluster(ClusterOffer{{{"show.toml", "0-ab", 1}}, {1}})));
  const ContentSource source({show_with("../../skies/sky.ppm")});
  EXPECT_FALSE(source.read({"0-abcdef", 0}));
  EXPECT_FALSE(source.read({source.offer().files[1].key, 1'000'000}));
}

TEST_F(ContentPush, RefusesAbsoluteNames) {
  try {
    const ContentSource source({show_with((folder_ / "skies" / "sky.ppm").string())});
    FAIL();
  } catch (const Error& problem) {
    EXPECT_THAT(problem.what(), HasSubstr("absolute path"));
  }
}

}  // namespace
}  // namespace ergodome
