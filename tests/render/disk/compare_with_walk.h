#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <random>
#include <tuple>
#include <utility>
#include <vector>

#include "tests/render/disk/flat_walk.h"

namespace ergodome::test {

//! Pixels at which objects may be: half of the wanted near to what is drawn of them, half near to where walks that are some pixels apart meet them.
class ObjectPixelsOfTest {
 public:
  ObjectPixelsOfTest(const Picture& picture, const FlatWalk& walk) : width_(picture.width), height_(picture.height) {
    constexpr int apart = 10;
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        if (luminance_of(light_at(picture, x, y)) > 0.0F) {
          drawn_.emplace_back(x, y);
        }
        if (x % apart == apart / 2 && y % apart == apart / 2 &&
            walk.look(x + 0.5, y + 0.5).met == FlatWalk::Met::object) {
          met_.emplace_back(x, y);
        }
      }
    }
  }

  //! One of them; anywhere where there are none.
  template <class Random>
  [[nodiscard]] std::pair<int, int> any(Random& random) const {
    const auto& from = random() % 2 == 0 ? drawn_ : met_;
    if (from.empty()) {
      return {static_cast<int>(random() % static_cast<unsigned>(width_)),
              static_cast<int>(random() % static_cast<unsigned>(height_))};
    }
    const auto& [x, y] = from[random() % from.size()];
    const auto beside = [&](int at, int size) {
      return std::clamp(at + static_cast<int>(random() % 9) - 4, 0, size - 1);
    };
    const int own_x = beside(x, width_);
    return {own_x, beside(y, height_)};
  }

 private:
  int width_, height_;
  std::vector<std::pair<int, int>> drawn_;
  std::vector<std::pair<int, int>> met_;
};

//! Whether an image of an object that is thinner than a pixel is in it.
inline bool is_partly_object(const FlatWalk& walk, int x, int y) {
  const float covered = walk.covered_part(x, y);
  return covered > 0.0F && covered < 1.0F;
}

//! Something of all that a show has near the hole was among so many pixels of each eye.
inline void expect_all_kinds_seen(const Show& show, std::map<FlatWalk::Met, int>& things, int pixels) {
  using Met = FlatWalk::Met;
  const int least = sanitized ? 0 : pixels / 20;
  EXPECT_GT(things[Met::disk] + things[Met::shell] + things[Met::object], least);
  const auto expect_seen = [&](bool there, Met met) {
    if (there && !sanitized) {
      EXPECT_GT(things[met], 0) << static_cast<int>(met);
    }
  };
  expect_seen(show.disk.has_value(), Met::disk);
  expect_seen(!show.shells.empty(), Met::shell);
  expect_seen(!show.objects.empty(), Met::object);
}

//! Holds both eyes' pictures to the walk, at random pixels that do not lie next to an edge.
inline void compare_with_walk(const Show& show, LensChoice lens, int pixels) {
  const auto eyes = eyes_of(show, lens);
  ASSERT_EQ(eyes.size(), 2U);
  std::mt19937 random(3);
  const bool objects_alone = !show.objects.empty() && !show.disk && show.shells.empty();
  std::map<FlatWalk::Met, int> things;
  for (std::size_t eye = 0; eye < 2; ++eye) {
    const FlatWalk walk(show, (eye == 0 ? -0.5 : 0.5) * show.stereo.baseline);
    const Picture& picture = eyes[eye];
    const std::optional<ObjectPixelsOfTest> of_objects =
        show.objects.empty() ? std::nullopt : std::optional<ObjectPixelsOfTest>(std::in_place, picture, walk);
    for (int i = 0; i < pixels; ++i) {
      int x = static_cast<int>(random() % static_cast<unsigned>(picture.width));
      int y = static_cast<int>(random() % static_cast<unsigned>(picture.height));
      if (of_objects) {
        std::tie(x, y) = of_objects->any(random);
      }
      const FlatWalk::Seen seen = walk.look(x + 0.5, y + 0.5);
      bool inside = true;
      double widest = 0.0;
      for (const auto& [dx, dy] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
        const FlatWalk::Seen beside = walk.look(x + 0.5 + dx, y + 0.5 + dy);
        inside = inside && beside.met == seen.met;
        widest = std::max(widest, std::abs(beside.r - seen.r));
      }
      // Images that are some pixels wide alone are one radius a pixel.
      if (!inside || widest > 0.1 * seen.r) {
        continue;
      }
      const float drawn = luminance_of(light_at(picture, x, y));
      if (objects_alone && drawn > 0.0F && drawn < 1.0F) {
        // An image that is thinner than a pixel: what samples of it see.
        EXPECT_NEAR(drawn, walk.covered_part(x, y), 0.35F) << (eye == 0 ? "left " : "right ") << x << ", " << y;
        continue;
      }
      const float light = walk.light_of(seen);
      const float off = 0.05F * light + 1e-4F;
      if (!show.objects.empty() && std::abs(drawn - light) > off && is_partly_object(walk, x, y)) {
        continue;
      }
      EXPECT_NEAR(drawn, light, off) << (eye == 0 ? "left " : "right ") << x << ", " << y << ": "
                                     << static_cast<int>(seen.met) << " " << seen.r;
      ++things[seen.met];
    }
  }
  expect_all_kinds_seen(show, things, pixels);
}

}  // namespace ergodome::test
