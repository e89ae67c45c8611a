#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
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

//! Holds both eyes' pictures to the walk, at random pixels that do not lie next to an edge.
inline void compare_with_walk(const Show& show, LensChoice lens, int pixels) {
  const auto eyes = eyes_of(show, lens);
  ASSERT_EQ(eyes.size(), 2U);
  std::mt19937 random(3);
  int things = 0;
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
      const bool lit = seen.met != FlatWalk::Met::nothing && seen.met != FlatWalk::Met::horizon;
      const Vector3<float> expected = seen.met == FlatWalk::Met::disk ? walk.light(seen.r) : Vector3<float>{1, 1, 1};
      const Vector3<float> drawn = light_at(picture, x, y);
      float size = lit ? luminance_of(expected) : 0.0F;
      if (!show.objects.empty() && luminance_of(drawn) > 0.0F && luminance_of(drawn) < 1.0F) {
        // An image that is thinner than a pixel: what samples of it see.
        size = walk.covered_part(x, y);
        EXPECT_NEAR(luminance_of(drawn), size, 0.35F) << (eye == 0 ? "left " : "right ") << x << ", " << y;
        continue;
      }
      EXPECT_NEAR(luminance_of(drawn), size, 0.05F * size + 1e-4F)
          << (eye == 0 ? "left " : "right ") << x << ", " << y << ": " << static_cast<int>(seen.met) << " " << seen.r;
      things += lit ? 1 : 0;
    }
  }
  EXPECT_GT(things, sanitized ? 0 : pixels / 20);
}

}  // namespace ergodome::test
