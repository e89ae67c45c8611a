#include "calibration/formats/mpcdi/zip_archive.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/calibration/handmade_files.h"
#include "tests/support/errors.h"

namespace ergodome {
namespace {

using testing::HasSubstr;

TEST(ZipArchive, MembersAreFoundWithoutRegardToCapitals) {
  const std::string bytes = test::zip_by_hand({{"Warp.PFM", "abc"}});
  ZipArchive archive(std::as_bytes(std::span(bytes)), "a.zip");
  EXPECT_TRUE(archive.has("warp.pfm"));
  EXPECT_FALSE(archive.has("warp"));
  EXPECT_EQ(archive.read("warp.pfm", 3), "abc");
}

TEST(ZipArchive, MemberBeyondItsBoundIsAnError) {
  const std::string bytes = test::zip_by_hand({{"a", "abc"}});
  ZipArchive archive(std::as_bytes(std::span(bytes)), "a.zip");
  EXPECT_THAT(test::error_of([&] { archive.read("a", 2); }), HasSubstr("a.zip: a: would unpack to 3 bytes"));
}

TEST(ZipArchive, MemberReadManyTimesCountsManyTimes) {
  const std::string bytes = test::zip_by_hand({{"a", "abc"}});
  ZipArchive archive(std::as_bytes(std::span(bytes)), "a.zip", 8);
  EXPECT_EQ(archive.read("a", 3), "abc");
  EXPECT_EQ(archive.read("a", 3), "abc");
  EXPECT_THAT(test::error_of([&] { archive.read("a", 3); }), HasSubstr("exceed the limit of the total"));
}

TEST(ZipArchive, OfOwnMakingReadsBack) {
  const std::string long_text(100'000, 'x');
  const std::string bytes = zip_of({{"empty", ""}, {"long", long_text}}, "a.zip");
  EXPECT_LT(bytes.size(), 1000U);
  ZipArchive archive(std::as_bytes(std::span(bytes)), "a.zip");
  EXPECT_EQ(archive.read("empty", 10), "");
  EXPECT_EQ(archive.read("long", 100'000), long_text);
}

}  // namespace
}  // namespace ergodome
