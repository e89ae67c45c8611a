#include "render/passes/stars/search/image_joiner.h"

#include "kernels/launch/launch.h"

namespace ergodome {

ImageJoiner::ImageJoiner(Backend backend, std::size_t stars)
    : backend_(backend),
      stars_(static_cast<int>(stars)),
      counts_(backend, stars, "star images"),
      first_(backend, stars + 1, "star images") {}

PlacedImages ImageJoiner::join(const BackendImages& found, const std::vector<SeenImage>& others, double pixel,
                               ImageOrder order) {
  const auto stars = static_cast<std::size_t>(stars_);
  reserve(backend_, others.size(), "star images", others_);
  others_.write(others.data(), others.size());
  ImageJoinBatch batch{{found.images, others_.data()},
                       {found.count, static_cast<int>(others.size())},
                       stars_,
                       pixel,
                       order,
                       counts_.data(),
                       first_.data(),
                       nullptr,
                       nullptr};
  clear(backend_, counts_, stars);
  launch(backend_, batch);
  sum_counts(backend_, counts_.data(), stars_, first_.data());
  std::int32_t count = 0;
  copy_to_host(backend_, &count, first_.data() + stars_, 1);
  PlacedImages placed;
  placed.count = count;
  if (count == 0) {
    return placed;
  }
  placed.images = Buffer<StarImage>(backend_, static_cast<std::size_t>(count), "star images");
  reserve(backend_, static_cast<std::size_t>(count), "star images", numbers_);
  batch.numbers = numbers_.data();
  batch.images = placed.images.data();
  clear(backend_, counts_, stars);
  batch.step = ImageJoinStep::number;
  launch(backend_, batch);
  batch.step = ImageJoinStep::take;
  launch(backend_, batch);
  return placed;
}

}  // namespace ergodome
