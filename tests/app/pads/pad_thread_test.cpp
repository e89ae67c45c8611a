#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "app/pads/pad_hub.h"
#include "tests/app/pads/fixtures.h"

namespace ergodome::test {
namespace {

//! A pad hub that runs in its own thread, with a clock that the test sets.
class PadThread : public testing::Test {
 protected:
  void start(const std::string& name) {
    hub_ = std::make_unique<PadHub>(std::make_unique<FixturePlayer>(fixture(name), [this] { return now_s_.load(); }),
                                    PadSettings{}, [this] { return now_s_.load(); });
    hub_->start();
  }

  //! Waits for the first snapshot that fulfills a condition, with a limit on the number of
  //! attempts.
  template <class Wanted>
  PadSnapshot wait_for(const Wanted& wanted) {
    PadSnapshot snapshot;
    for (int i = 0; i < 10'000; ++i) {
      snapshot = hub_->snapshot();
      if (wanted(snapshot)) {
        return snapshot;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    ADD_FAILURE() << "what was waited for did not come";
    return snapshot;
  }

  std::atomic<double> now_s_{0.0};
  std::unique_ptr<PadHub> hub_;
};

TEST_F(PadThread, FindsReadsAndLetsGo) {
  start("two_identical");
  wait_for([](const PadSnapshot& all) { return all.pads.size() == 3; });
  now_s_ = 0.15;
  const PadSnapshot pressed = wait_for([](const PadSnapshot& all) { return all.merged().pressed(PadButton::south); });
  EXPECT_EQ(pressed.merged().axis(PadAxis::left_x), 1.0F);
  now_s_ = 0.3;
  const PadSnapshot gone = wait_for([](const PadSnapshot& all) { return !all.merged().pressed(PadButton::south); });
  EXPECT_EQ(gone.merged().axis(PadAxis::left_x), 0.0F);
  EXPECT_GT(gone.merged().axis(PadAxis::left_y), 0.9F);
}

TEST_F(PadThread, StopsWhileNothingIsPluggedIn) {
  start("mouse_and_keyboard");
  wait_for([](const PadSnapshot& all) { return all.pads.empty(); });
  hub_->stop();
  hub_->stop();
}

TEST_F(PadThread, EndsWithTheRealLibraryWhateverIsThere) {
  PadHub hub(make_hid_library());
  hub.start();
  hub.snapshot();
}

}  // namespace
}  // namespace ergodome::test
