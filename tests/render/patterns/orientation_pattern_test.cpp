#include <gtest/gtest.h>

#include <cmath>

#include "kernels/core/angles.h"
#include "kernels/projection/make_projection.h"
#include "render/output/text_image.h"
#include "render/patterns/patterns.h"

namespace ergodome {
namespace {

constexpr int size_px = 512;

//! The position of the letters of a word in a pattern. They are found by their color.
struct Letters {
  double x = 0.0;  //!< center, as a fraction of the width from the left
  double y = 0.0;  //!< center, as a fraction of the height from the top
  int count = 0;
  int left = size_px, right = 0, top = size_px, bottom = 0;
};

const float* light_at(const Picture& picture, int x, int y) {
  return picture.rgba.data() + 4 * (static_cast<std::ptrdiff_t>(y) * picture.width + x);
}

Letters letters_of(const Picture& picture, const char* text) {
  Letters letters;
  for (const DomeLabel& label : orientation_labels()) {
    if (label.text != text) {
      continue;
    }
    for (int y = 0; y < picture.height; ++y) {
      for (int x = 0; x < picture.width; ++x) {
        const float* at = light_at(picture, x, y);
        const float apart =
            std::abs(at[0] - label.colour.x) + std::abs(at[1] - label.colour.y) + std::abs(at[2] - label.colour.z);
        if (apart < 0.3F) {
          letters.x += x + 0.5;
          letters.y += y + 0.5;
          ++letters.count;
          letters.left = std::min(letters.left, x);
          letters.right = std::max(letters.right, x + 1);
          letters.top = std::min(letters.top, y);
          letters.bottom = std::max(letters.bottom, y + 1);
        }
      }
    }
  }
  letters.x /= std::max(letters.count, 1) * static_cast<double>(picture.width);
  letters.y /= std::max(letters.count, 1) * static_cast<double>(picture.height);
  return letters;
}

Picture dome_pattern() { return orientation_pattern(make_dome_projection(size_px, pi, 0.0)); }

TEST(OrientationPattern, HasTheFrontAtTheBottomOfADomemaster) {
  const Letters front = letters_of(dome_pattern(), "FRONT");
  ASSERT_GT(front.count, 50);
  EXPECT_NEAR(front.x, 0.5, 0.02);
  EXPECT_GT(front.y, 0.9);
}

TEST(OrientationPattern, HasLeftOnTheLeftAndRightOnTheRight) {
  const Picture picture = dome_pattern();
  EXPECT_LT(letters_of(picture, "LEFT").x, 0.1);
  EXPECT_GT(letters_of(picture, "RIGHT").x, 0.9);
}

TEST(OrientationPattern, HasTheBackAtTheTop) { EXPECT_LT(letters_of(dome_pattern(), "BACK").y, 0.1); }

TEST(OrientationPattern, FromOutsideHasLeftOnTheRight) {
  const Picture picture = orientation_pattern(seen_from_outside(make_dome_projection(size_px, pi, 0.0)));
  EXPECT_GT(letters_of(picture, "LEFT").x, 0.9);
}

//! Returns how similar the letters in the picture are to the word as it should be written: a
//! correlation coefficient.
double likeness(const Picture& picture, const char* text, bool mirrored) {
  const Letters box = letters_of(picture, text);
  const TextImage written = text_image(text, 48);
  double sums[5] = {};
  int count = 0;
  for (int y = box.top; y < box.bottom; ++y) {
    for (int x = box.left; x < box.right; ++x) {
      const double across = (x + 0.5 - box.left) / (box.right - box.left);
      const double down = (y + 0.5 - box.top) / (box.bottom - box.top);
      const int column = static_cast<int>((mirrored ? 1.0 - across : across) * written.width);
      const int row = static_cast<int>(down * written.height);
      const double a =
          static_cast<double>(written.coverage[static_cast<std::size_t>(row) * static_cast<std::size_t>(written.width) +
                                               static_cast<std::size_t>(column)]);
      const double b = static_cast<double>(light_at(picture, x, y)[0]);
      const double parts[5] = {a, b, a * a, b * b, a * b};
      for (int i = 0; i < 5; ++i) {
        sums[i] += parts[i];
      }
      ++count;
    }
  }
  const double covariance = sums[4] - sums[0] * sums[1] / count;
  return covariance / std::sqrt((sums[2] - sums[0] * sums[0] / count) * (sums[3] - sums[1] * sums[1] / count));
}

TEST(OrientationPattern, ReadsUprightForAViewerWhoFacesIt) {
  const Picture picture = orientation_pattern(make_pinhole_projection(size_px, size_px, 0.7));
  EXPECT_GT(likeness(picture, "FRONT", false), 0.8);
  EXPECT_LT(likeness(picture, "FRONT", true), 0.6);
}

TEST(OrientationPattern, ReadsUprightOnTheDomeAboveAViewerWhoFacesTheFront) {
  // The top of a domemaster is the back of the dome. Text that is upright in the domemaster is
  // upright for a viewer who leans back and looks up.
  const Picture picture = dome_pattern();
  EXPECT_GT(likeness(picture, "ZENITH", false), 0.6);
}

TEST(OrientationPattern, IsBlackWhereAProjectionHasNoImage) {
  const Picture picture = orientation_pattern(make_cube_projection(64, CubeLayout::cross));
  EXPECT_EQ(picture.rgba[3], 0.0F);
  EXPECT_EQ(picture.rgba[0], 0.0F);
  EXPECT_EQ(picture.rgba[4 * (64 * 4 * 80 + 10) + 3], 1.0F);
}

}  // namespace
}  // namespace ergodome
