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

#include "tests/render/passes/disk/flat_walk.h"

// Compares pictures for eyes of the model `flat` with FlatWalk, which follows their lines of sight.
namespace ergodome::test {

//! Pixels for a comparison, in two lists: pixels in which the picture shows objects, and pixels of
//! a lattice whose lines of sight meet objects.
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
            walk.seen_at(x + 0.5, y + 0.5).met == FlatWalk::Met::object) {
          met_.emplace_back(x, y);
        }
      }
    }
  }

  //! Returns a random pixel close to a pixel of one of the lists; each list is chosen in half of
  //! the calls. If the list is empty, returns any pixel of the picture.
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

//! Expects that the compared pixels include each kind of object that the show has near the hole.
//! `things`: number of pixels of each kind.
inline void expect_all_kinds_seen(const Show& show, std::map<FlatWalk::Met, int>& things, int pixels) {
  using Met = FlatWalk::Met;
  // If few pixels are compared, as under sanitizers, all may be next to edges and count for no
  // kind.
  EXPECT_GE(things[Met::disk] + things[Met::shell] + things[Met::object], sanitized ? 0 : pixels / 20 + 1);
  const auto expect_seen = [&](bool there, Met met) {
    if (there && !sanitized) {
      EXPECT_GT(things[met], 0) << static_cast<int>(met);
    }
  };
  expect_seen(show.disk.has_value(), Met::disk);
  expect_seen(!show.shells.empty(), Met::shell);
  expect_seen(!show.objects.empty(), Met::object);
}

//! Returns whether a pixel and its four neighbors see the same kind of object at nearly the same
//! radius. Images that are only a few pixels wide are excluded, because their radius differs from
//! pixel to pixel.
inline bool is_within_one_thing(const FlatWalk& walk, int x, int y, const FlatWalk::Seen& seen) {
  bool inside = true;
  for (const auto& [dx, dy] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
    const FlatWalk::Seen beside = walk.seen_at(x + 0.5 + dx, y + 0.5 + dy);
    inside = inside && beside.met == seen.met && !(std::abs(beside.r - seen.r) > 0.1 * seen.r);
  }
  return inside;
}

//! Compares a pixel of the picture with what FlatWalk sees in its middle, and returns true. If
//! images in the pixel are thinner than the pixel, compares it with what FlatWalk sees at many
//! positions in it, and returns false.
inline bool compare_pixel(const Show& show, const FlatWalk& walk, const Picture& picture, int x, int y,
                          const FlatWalk::Seen& seen) {
  const float drawn = luminance_of(light_at(picture, x, y));
  const float light = walk.light_of(seen);
  const float off = 0.05F * light + 1e-4F;
  const bool objects_alone = !show.disk && show.shells.empty();
  if (!show.objects.empty() && (objects_alone ? drawn > 0.0F && drawn < 1.0F : std::abs(drawn - light) > off)) {
    const float covered = walk.covered_part(x, y);
    if (objects_alone) {
      EXPECT_NEAR(drawn, covered, 0.35F) << x << ", " << y;
      return false;
    }
    if (covered > 0.0F && covered < 1.0F) {
      const auto [minimum, maximum] = walk.light_range(x, y);
      EXPECT_GE(drawn, 0.95F * minimum) << x << ", " << y;
      EXPECT_LE(drawn, 1.05F * maximum) << x << ", " << y;
      return false;
    }
  }
  EXPECT_NEAR(drawn, light, off) << x << ", " << y << ": " << static_cast<int>(seen.met) << " " << seen.r;
  return true;
}

//! Compares the pictures of both eyes with FlatWalk, at random pixels that are not next to an edge.
inline void compare_with_walk(const Show& show, LensChoice lens, int pixels) {
  const auto eyes = eyes_of(show, lens);
  ASSERT_EQ(eyes.size(), 2U);
  std::mt19937 random(3);
  std::map<FlatWalk::Met, int> things;
  for (std::size_t eye = 0; eye < 2; ++eye) {
    SCOPED_TRACE(eye == 0 ? "left" : "right");
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
      const FlatWalk::Seen seen = walk.seen_at(x + 0.5, y + 0.5);
      if (is_within_one_thing(walk, x, y, seen) && compare_pixel(show, walk, picture, x, y, seen)) {
        ++things[seen.met];
      }
    }
  }
  expect_all_kinds_seen(show, things, pixels);
}

}  // namespace ergodome::test
