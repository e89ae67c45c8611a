#include "app/commands/render/frame_range.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/cli/usage_error.h"
#include "content/show/show.h"

namespace ergodome {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;
using namespace std::chrono_literals;
using FrameSpanPair = std::pair<int, int>;

Show show_of(double duration_s, double frame_rate_hz) {
  Show show;
  show.duration_s = duration_s;
  show.frame_rate_hz = frame_rate_hz;
  return show;
}

TEST(Moment, IsReadWithItsUnit) {
  EXPECT_EQ(moment_of("--from", "12s"), 12s);
  EXPECT_EQ(moment_of("--from", "1.5s"), 1500ms);
  EXPECT_EQ(moment_of("--from", "500ms"), 500ms);
  EXPECT_EQ(moment_of("--from", "2min"), 120s);
  EXPECT_EQ(moment_of("--from", "1:30"), 90s);
  EXPECT_EQ(moment_of("--from", "0:00.25"), 250ms);
  EXPECT_EQ(moment_of("--from", "1:02:03"), 3723s);
  EXPECT_EQ(moment_of("--from", "90:00"), 5400s);
}

TEST(Moment, IsNoNumberOfAFrame) {
  EXPECT_THAT([] { moment_of("--from", "12"); },
              ThrowsMessage<UsageError>(HasSubstr("write 12s for a time; use --frames")));
  EXPECT_THAT([] { frame_range("12s:22s", 900); }, ThrowsMessage<UsageError>(HasSubstr("use --from and --to")));
  EXPECT_THAT([] { frame_range("12s", 900); }, ThrowsMessage<UsageError>(HasSubstr("is not a frame number")));
}

TEST(Moment, IsRefusedWhereItCouldBeRead) {
  for (const char* const text : {"", "s", "-1s", "+1s", "1e3s", "nans", "1 s", "1:60", "1:2:3:4", ":30", "1:", "1.5:30",
                                 "1s:2s", "0x10s", "1h", "1:30s"}) {
    EXPECT_THAT([&] { moment_of("--to", text); }, ThrowsMessage<UsageError>(HasSubstr("is not a time"))) << text;
  }
}

TEST(FramesBetween, BeginAtOrAfterTheFirstTimeAndBeforeTheSecond) {
  const Show show = show_of(30.0, 30.0);
  EXPECT_EQ(frames_between("", "", show), FrameSpanPair(0, 899));
  EXPECT_EQ(frames_between("12s", "22s", show), FrameSpanPair(360, 659));
  EXPECT_EQ(frames_between("22s", "", show), FrameSpanPair(660, 899));
  EXPECT_EQ(frames_between("", "30s", show), FrameSpanPair(0, 899));
  // At 30 Hz, frame 1 (counted from 0) starts at 33.3 ms.
  EXPECT_EQ(frames_between("33ms", "34ms", show), FrameSpanPair(1, 1));
}

TEST(FramesBetween, ShareNoneWhereTheyMeet) {
  const Show show = show_of(20.0, 30000.0 / 1001.0);
  for (const char* const time : {"1s", "3.337s", "10.01s", "0:19"}) {
    EXPECT_EQ(frames_between("", time, show).second + 1, frames_between(time, "", show).first) << time;
  }
  // At 30000/1001 Hz, 10.01 s are exactly 300 frames.
  EXPECT_EQ(frames_between("10.01s", "", show).first, 300);
}

TEST(FramesBetween, LieInTheShow) {
  const Show show = show_of(30.0, 30.0);
  EXPECT_THAT(
      [&] { frames_between("12s", "31s", show); },
      ThrowsMessage<UsageError>(HasSubstr("--to 31s: is after the end of the show at 30 s; choose a time from")));
  EXPECT_THAT([&] { frames_between("1:00", "", show); }, ThrowsMessage<UsageError>(HasSubstr("--from 1:00: is after")));
  for (const auto& [from, to] :
       {std::pair("22s", "12s"), {"12s", "12s"}, {"30s", ""}, {"", "0s"}, {"12.001s", "12.002s"}}) {
    const auto refused = [first = from, second = to, &show] { frames_between(first, second, show); };
    EXPECT_THAT(refused, ThrowsMessage<UsageError>(HasSubstr("contains no frame"))) << from << ' ' << to;
  }
}

}  // namespace
}  // namespace ergodome
