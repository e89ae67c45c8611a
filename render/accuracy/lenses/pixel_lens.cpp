#include "render/accuracy/lenses/pixel_lens.h"

#include "kernels/launch/parallel_for.h"

namespace ergodome {

namespace {

template <class S>
std::unique_ptr<RayPicture<S>> make_rays(const EyeCamera& eye, const Projection& projection) {
  auto rays = std::make_unique<RayPicture<S>>();
  for (int y = 0; y < projection.height_px; ++y) {
    for (int x = 0; x < projection.width_px; ++x) {
      if (image_coverage(projection, x + 0.5, y + 0.5) > 0.0) {
        rays->pixels.push_back(static_cast<std::int64_t>(y) * projection.width_px + x);
      }
    }
  }
  const std::size_t count = rays->pixels.size();
  rays->status.resize(count);
  for (int k = 0; k < 3; ++k) {
    rays->n[k].resize(count);
    rays->sky[k].resize(count);
  }
  parallel_for(static_cast<int>(count), 4096, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const auto [x, y] = pixel_middle(rays->pixels[at], projection.width_px);
      const Vector3<double> view = direction_from_pixel(projection, x, y);
      for (int k = 0; k < 3; ++k) {
        const double(&m)[3] = eye.frame_from_view[k];
        rays->n[k][at] = static_cast<S>(m[0] * view.x + m[1] * view.y + m[2] * view.z);
      }
    }
  });
  return rays;
}

}  // namespace

LensScene::LensScene(const AccuracyMoment& moment, FrameOfMoment frame, PixelNeed need)
    : moment_(moment), frame_(frame), need_(need) {}

template <>
RayPicture<float>& LensScene::rays<float>() {
  if (!narrow_) {
    narrow_ = make_rays<float>(eye(), projection());
  }
  return *narrow_;
}

template <>
RayPicture<double>& LensScene::rays<double>() {
  if (!wide_) {
    wide_ = make_rays<double>(eye(), projection());
  }
  return *wide_;
}

LensPixels& LensScene::pixels() {
  if (channels_.empty()) {
    const std::size_t count =
        static_cast<std::size_t>(projection().width_px) * static_cast<std::size_t>(projection().height_px);
    channels_.resize((need_ == PixelNeed::footprint ? 10 : 4) * count);
    float* next = channels_.data();
    const auto take = [&](float*& channel) {
      channel = next;
      next += count;
    };
    take(pixels_.coverage);
    for (float*& channel : pixels_.sky) {
      take(channel);
    }
    for (int k = 0; k < 3 && need_ == PixelNeed::footprint; ++k) {
      take(pixels_.sky_along_x[k]);
      take(pixels_.sky_along_y[k]);
    }
  }
  return pixels_;
}

}  // namespace ergodome
