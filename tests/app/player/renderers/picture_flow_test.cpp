#include "app/player/renderers/picture_flow.h"

#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <stdexcept>
#include <thread>
#include <vector>

namespace ergodome {
namespace {

//! A fake renderer that records the widths of the requested pictures.
class FakeRenderer {
 public:
  std::vector<int> sizes;
  std::atomic<bool> fails = false;

  PictureAnswer operator()(const PictureRequest& request) {
    if (fails) {
      throw std::runtime_error("the sky is falling");
    }
    sizes.push_back(request.size_px);
    PictureAnswer answer;
    answer.picture.width = request.size_px;
    answer.picture.height = request.size_px;
    return answer;
  }
};

//! Calls advance() until it reports news.
PictureNews wait_for_news(PictureFlow& flow, bool moving) {
  for (int i = 0; i < 20000; ++i) {
    const PictureNews news = flow.advance({}, false, moving);
    if (news != PictureNews::none) {
      return news;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return PictureNews::none;
}

TEST(FrameSource, IsNotIdleUntilItsAnswerIsTaken) {
  FrameSource source([](const PictureRequest&) { return PictureAnswer(); });
  EXPECT_TRUE(source.idle());
  EXPECT_FALSE(source.take().has_value());
  source.ask({});
  for (int i = 0; i < 100; ++i) {
    ASSERT_FALSE(source.idle()) << "the answer of this request would be taken for that of the next one";
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  std::optional<PictureAnswer> answer;
  for (int i = 0; i < 20'000 && !answer; ++i) {
    answer = source.take();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_TRUE(answer.has_value());
  EXPECT_TRUE(source.idle());
}

TEST(PictureFlow, RefinesWhatStandsStillToTheFinestWidth) {
  FakeRenderer renderer;
  std::vector<int> shown;
  PictureFlow flow([&](const PictureAnswer& answer) { shown.push_back(answer.picture.width); }, 1000,
                   std::ref(renderer));
  while (shown.empty() || shown.back() < 1000) {
    ASSERT_EQ(wait_for_news(flow, false), PictureNews::picture);
  }
  EXPECT_EQ(shown, (std::vector<int>{256, 512, 1000}));
}

TEST(PictureFlow, DoesNotRefineWhatMoves) {
  FakeRenderer renderer;
  int shown = 0;
  PictureFlow flow([&](const PictureAnswer&) { ++shown; }, 1000, std::ref(renderer));
  ASSERT_EQ(wait_for_news(flow, true), PictureNews::picture);
  for (int i = 0; i < 50; ++i) {
    EXPECT_EQ(flow.advance({}, false, true), PictureNews::none);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_EQ(shown, 1);
}

TEST(PictureFlow, HoldsTheSizeAndThePaceOfWhatMoves) {
  FakeRenderer renderer;
  std::atomic<double> now_s = 10.0;
  int shown = 0;
  PictureFlow flow([&](const PictureAnswer&) { ++shown; }, 1000, std::ref(renderer), [&] { return now_s.load(); });
  flow.hold({400, 0.5});
  flow.advance({}, true, true);
  ASSERT_EQ(wait_for_news(flow, true), PictureNews::picture);
  EXPECT_FALSE(flow.report().interval_ms.has_value());
  // No picture is requested before the flow's frame interval is over.
  now_s = 10.2;
  for (int i = 0; i < 20; ++i) {
    EXPECT_EQ(flow.advance({}, true, true), PictureNews::none);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  now_s = 10.6;
  ASSERT_EQ(wait_for_news(flow, true), PictureNews::picture);
  EXPECT_NEAR(*flow.report().interval_ms, 600.0, 1e-6);
  EXPECT_EQ(renderer.sizes, (std::vector<int>{400, 400}));
}

TEST(PictureFlow, RefinesWhatStandsStillWhateverPaceIsHeld) {
  FakeRenderer renderer;
  PictureFlow flow([](const PictureAnswer&) {}, 1000, std::ref(renderer), [] { return 10.0; });
  flow.hold({400, 0.5});
  while (renderer.sizes.empty() || flow.report().size_px < 1000) {
    ASSERT_EQ(wait_for_news(flow, false), PictureNews::picture);
    EXPECT_FALSE(flow.report().interval_ms.has_value());
  }
  EXPECT_EQ(renderer.sizes, (std::vector<int>{400, 800, 1000}));
}

TEST(PictureFlow, KeepsTheLastPictureWhereOneFails) {
  FakeRenderer renderer;
  int shown = 0;
  PictureFlow flow([&](const PictureAnswer&) { ++shown; }, 256, std::ref(renderer));
  ASSERT_EQ(wait_for_news(flow, false), PictureNews::picture);
  renderer.fails = true;
  flow.advance({}, true, false);
  ASSERT_EQ(wait_for_news(flow, false), PictureNews::problem);
  EXPECT_EQ(flow.report().problem, "the sky is falling");
  EXPECT_EQ(shown, 1);
}

TEST(PictureFlow, GivesUpAPictureThatHangsAndGoesOn) {
  std::promise<void> release;
  const std::shared_future<void> released = release.get_future().share();
  std::atomic<bool> hangs = false;
  std::atomic<int> ended = 0;
  std::atomic<int> shown = 0;
  {
    PictureFlow flow([&](const PictureAnswer&) { ++shown; }, 256,
                     [&](const PictureRequest&) {
                       if (hangs.exchange(false)) {
                         released.wait();
                         ++ended;
                       }
                       return PictureAnswer();
                     });
    ASSERT_EQ(wait_for_news(flow, false), PictureNews::picture);
    hangs = true;
    flow.advance({}, true, false);
    EXPECT_EQ(wait_for_news(flow, false), PictureNews::hang);
    EXPECT_EQ(wait_for_news(flow, false), PictureNews::picture);
    EXPECT_EQ(flow.report().hangs, 1);
    EXPECT_EQ(shown, 2);
  }
  release.set_value();
  while (ended == 0) {
    std::this_thread::yield();
  }
}

//! A gate that opens when the test wants it to.
class FakeGate : public PictureGate {
 public:
  bool open = false;
  int published = 0;
  void publish(PictureRequest& request) override {
    ++published;
    request.size_px = 100;
  }
  bool release(PictureAnswer& answer) override {
    answer.time_ms = 500.0;
    return open;
  }
};

TEST(PictureFlow, ShowsAPictureWhenTheGateReleasesIt) {
  FakeRenderer renderer;
  std::vector<int> shown;
  PictureFlow flow([&](const PictureAnswer& answer) { shown.push_back(answer.picture.width); }, 1000,
                   std::ref(renderer));
  FakeGate gate;
  flow.set_gate(&gate);
  for (int i = 0; i < 50; ++i) {
    EXPECT_EQ(flow.advance({}, true, true), PictureNews::none);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_EQ(gate.published, 1) << "the next picture waits for the release of this one";
  gate.open = true;
  EXPECT_EQ(wait_for_news(flow, true), PictureNews::picture);
  EXPECT_EQ(shown, std::vector<int>{100}) << "the gate may change the request";
  EXPECT_EQ(flow.report().frame_time_ms, 500.0);
  EXPECT_EQ(gate.published, 2);
}

//! Counts released pictures that answer an earlier request than the one that was published last.
class NumberingGate : public PictureGate {
 public:
  int published = 0;
  int mistaken = 0;
  void publish(PictureRequest& request) override { request.size_px = ++published; }
  bool release(PictureAnswer& answer) override {
    mistaken += answer.size_px != published ? 1 : 0;
    return true;
  }
};

TEST(PictureFlow, ReleasesEachPictureBeforeTheNextIsPublished) {
  FakeRenderer renderer;
  int shown = 0;
  NumberingGate gate;
  PictureFlow flow([&](const PictureAnswer&) { ++shown; }, 1000, std::ref(renderer));
  flow.set_gate(&gate);
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (shown < 20'000 && std::chrono::steady_clock::now() < end) {
    flow.advance({}, true, true);
  }
  EXPECT_GT(shown, 1000);
  EXPECT_EQ(gate.mistaken, 0);
  EXPECT_LE(gate.published - shown, 1 + flow.report().hangs);
}

}  // namespace
}  // namespace ergodome
