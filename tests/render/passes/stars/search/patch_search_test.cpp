#include "render/passes/stars/search/patch_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <vector>

#include "render/passes/stars/search/star_finder.h"
#include "tests/render/passes/stars/star_cameras.h"
#include "tests/support/sanitized.h"

// The star search for GPUs, which handles one pair of patch and star per thread, must find the same
// images as the search for CPUs, which handles SIMD packs of pairs. Both run on the CPU here. If
// there is a GPU, the test CudaPictures compares the pictures.
namespace ergodome {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): the cameras and stars of these tests

//! Runs both searches for the sky of one camera.
struct Searches {
  StarField field;
  EyeCamera eye;
  StarSettings settings;
  LensStation station = build_star_station(eye, settings);
  StarPatches patches = star_patches(field, colours().view(), eye, station, settings);

  [[nodiscard]] std::vector<StarImage> on_processor() const {
    return sorted(find_star_images(field, colours().view(), eye, station, patches, settings));
  }

  [[nodiscard]] std::vector<StarImage> as_on_device() const {
    PatchSearch search(Backend::cpu, field, colours().view());
    const PlacedPatches placed(Backend::cpu, patches, station);
    ImageJoiner joiner(Backend::cpu, field.stars().size());
    const DeviceSearch device = {search, placed, joiner};
    return sorted(find_star_images(field, colours().view(), eye, station, patches, settings, &device));
  }

  //! Sorts images by star, then by position.
  static std::vector<StarImage> sorted(std::vector<StarImage> images) {
    const auto key = [](const StarImage& image) {
      return std::tuple(image.star, std::lround(1e3F * image.direction.x), std::lround(1e3F * image.direction.y),
                        image.direction.z);
    };
    std::ranges::sort(images, {}, key);
    return images;
  }
};

StarField field_of(std::size_t stars) { return {brightest(stars), glm::dmat3(1.0), colours().view()}; }

//! Counts the images of a list that have no counterpart in the other list. A counterpart is an
//! image of the same star, close to it and nearly as bright.
long without_partner(const std::vector<StarImage>& of, const std::vector<StarImage>& among) {
  return std::ranges::count_if(of, [&](const StarImage& image) {
    const auto first = std::ranges::lower_bound(among, image.star, {}, &StarImage::star);
    const auto last = std::ranges::upper_bound(among, image.star, {}, &StarImage::star);
    return std::none_of(first, last, [&](const StarImage& other) {
      const Vector3<float> apart = image.direction - other.direction;
      return dot(apart, apart) < 1e-10F && std::abs(other.illuminance.y / image.illuminance.y - 1.0F) < 0.01F;
    });
  });
}

class PatchSearches : public testing::TestWithParam<CameraState> {};

TEST_P(PatchSearches, FindTheSameImages) {
  const Searches searches{field_of(sanitized ? 300 : 5000), eye_at_position(GetParam()), settings_for(9.0)};
  const std::vector<StarImage> here = searches.on_processor();
  const std::vector<StarImage> there = searches.as_on_device();
  ASSERT_GT(here.size(), sanitized ? 200U : 3000U);
  // If an image was found twice, either of the duplicates may be kept. Near caustics, duplicates
  // differ slightly.
  const auto few = static_cast<long>(here.size() / 1000 + 1);
  EXPECT_LE(without_partner(here, there), few);
  EXPECT_LE(without_partner(there, here), few);
  EXPECT_NEAR(static_cast<double>(there.size()), static_cast<double>(here.size()), 2.0);
}

INSTANTIATE_TEST_SUITE_P(Of, PatchSearches, testing::ValuesIn(positions),
                         [](const auto& each) { return "Camera" + std::to_string(each.index); });

TEST(PatchSearch, LooksWhereTheViewIsAlone) {
  Searches searches{field_of(2000), eye_at_position(positions[2]), settings_for(8.0)};
  const std::size_t all = searches.as_on_device().size();
  searches.settings.view = view_cone(searches.eye, make_pinhole_projection(64, 64, 1.2), 0.05);
  const std::vector<StarImage> seen = searches.as_on_device();
  EXPECT_GT(seen.size(), 0U);
  EXPECT_LT(seen.size(), all / 2);
  EXPECT_EQ(without_partner(searches.on_processor(), seen), 0);
}

TEST(PatchSearch, MakesRoomForMoreThanItHad) {
  const Searches searches{field_of(2000), eye_at_position(positions[2]), settings_for(8.0)};
  const PlacedPatches placed(Backend::cpu, searches.patches, searches.station);
  const ImageObserver observer(searches.eye, searches.station, colours().view(), false);
  const PatchSearch::Request request = {searches.eye.phi, {}, observer, {searches.settings.faintest, false, true}};
  PatchSearch roomy(Backend::cpu, searches.field, colours().view());
  const PatchSearch::Result expected = roomy.find(placed, request);
  ASSERT_GT(expected.exact.count, 500);
  for (const int room : {0, 16}) {
    PatchSearch narrow(Backend::cpu, searches.field, colours().view(), room);
    const PatchSearch::Result found = narrow.find(placed, request);
    EXPECT_EQ(found.exact.count, expected.exact.count) << room;
    EXPECT_EQ(found.rough.size(), expected.rough.size()) << room;
  }
}

}  // namespace
}  // namespace ergodome
