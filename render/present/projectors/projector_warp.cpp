#include "render/present/projectors/projector_warp.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <span>
#include <utility>

#include "kernels/launch/parallel_for.h"
#include "render/present/projectors/projector_mesh.h"

namespace ergodome {

namespace {

constexpr float full_scale = 65535.0F;

//! Returns an integer whose square, relative to the square of the maximum integer, is `part` (0 to
//! 1).
std::uint16_t root_of(float part) {
  return static_cast<std::uint16_t>(std::lround(full_scale * std::sqrt(std::clamp(part, 0.0F, 1.0F))));
}

//! Interpolates a channel of a mask; returns 1 without a mask.
float read(const BlendMap& mask, const float (&position)[2], int channel) {
  if (mask.width == 0) {
    return 1.0F;
  }
  const auto neighbours = [](float at, int size, int& first, int& second) {
    const float exact = std::clamp(at * static_cast<float>(size) - 0.5F, 0.0F, static_cast<float>(size - 1));
    first = static_cast<int>(exact);
    second = std::min(first + 1, size - 1);
    return exact - static_cast<float>(first);
  };
  int left = 0;
  int right = 0;
  int top = 0;
  int bottom = 0;
  const float across = neighbours(position[0], mask.width, left, right);
  const float down = neighbours(position[1], mask.height, top, bottom);
  const auto at = [&](int column, int row) {
    const std::size_t sample =
        static_cast<std::size_t>(row) * static_cast<std::size_t>(mask.width) + static_cast<std::size_t>(column);
    return mask.values[static_cast<std::size_t>(mask.channels) * sample +
                       static_cast<std::size_t>(mask.channels == 1 ? 0 : channel)];
  };
  return std::lerp(std::lerp(at(left, top), at(right, top), across),
                   std::lerp(at(left, bottom), at(right, bottom), across), down);
}

float largest(const std::vector<float>& values) {
  return values.empty() ? 1.0F : std::max(*std::ranges::max_element(values), 1e-6F);
}

//! Allocates zeros in host memory.
template <class T>
Buffer<T> zeros(std::size_t count) {
  Buffer<T> made(Backend::cpu, count, "projector's warp");
  clear(Backend::cpu, made, count);
  return made;
}

//! Moves a buffer from host memory to the backend's memory.
template <class T>
void move_there(Backend backend, Buffer<T>& buffer) {
  Buffer<T> there(backend, buffer.size(), "projector's warp");
  there.write(buffer.data(), buffer.size());
  buffer = std::move(there);
}

float channel_of(const Vector3<double>& v, int channel) {
  return static_cast<float>(channel == 0 ? v.x : channel == 1 ? v.y : v.z);
}

//! Quantization of a group's positions to 65536 evenly spaced values from their minimum to their
//! maximum.
struct Lattice {
  float first = 0.0F;
  float step = 0.0F;

  explicit Lattice(std::span<const float> positions) {
    const auto [minimum, maximum] = std::ranges::minmax(positions);
    first = minimum;
    step = (maximum - minimum) / full_scale;
  }
  [[nodiscard]] std::uint16_t number(float position) const {
    return static_cast<std::uint16_t>(step > 0.0F ? std::lround(std::clamp((position - first) / step, 0.0F, full_scale))
                                                  : 0);
  }
};

}  // namespace

//! Computes a warp, one band of rows at a time; several bands may be computed in parallel.
class ProjectorWarp::Builder {
 public:
  Builder(ProjectorWarp& warp, const ProjectorPicture& picture, float max_factor)
      : warp_(warp), picture_(picture), max_factor_(max_factor) {}

  void fill(int first_row, std::span<const MeshSample> samples) {
    LightTiles tiles(warp_.tiles_.width(0), warp_.tiles_.height(0));
    const auto width = static_cast<std::size_t>(warp_.width_px_);
    const auto groups = static_cast<std::size_t>(warp_groups(warp_.width_px_));
    for (std::size_t row = 0; row < samples.size() / width; ++row) {
      for (std::size_t i = 0; i < groups; ++i) {
        const std::size_t column = i * warp_group_px;
        fill_group((static_cast<std::size_t>(first_row) + row) * groups + i,
                   samples.subspan(row * width + column, std::min<std::size_t>(warp_group_px, width - column)), tiles);
      }
    }
    const std::lock_guard lock(mutex_);
    warp_.tiles_.join(tiles);
  }

 private:
  //! Returns the mip level at which texels have the size of the projector's pixel, in units of 1 /
  //! warp_level_steps of a level.
  [[nodiscard]] std::uint8_t level_of(const MeshSample& sample) const {
    const auto width = static_cast<float>(warp_.tiles_.width(0));
    const auto height = static_cast<float>(warp_.tiles_.height(0));
    const float size_px = std::max(std::hypot(width * sample.along_x[0], height * sample.along_x[1]),
                                   std::hypot(width * sample.along_y[0], height * sample.along_y[1]));
    const auto coarsest = static_cast<float>(warp_.tiles_.level_count() - 1);
    const float level = size_px > 1.0F ? std::min(std::log2(size_px), coarsest) : 0.0F;
    return static_cast<std::uint8_t>(std::lround(level * warp_level_steps));
  }

  void set_factors(std::size_t group, std::size_t i, const MeshSample& sample) {
    if (!warp_.coloured_) {
      warp_.factor_.data()[group * warp_group_px + i] =
          root_of(sample.factor * read(picture_.blend, sample.mask, 0) / max_factor_);
      return;
    }
    for (int c = 0; c < 3; ++c) {
      const float lift = read(picture_.black_level, sample.mask, c);
      const float left = 1.0F - channel_of(picture_.black_level_lift, c) * lift;
      std::uint16_t* const to = &warp_.factor_.data()[(6 * group + static_cast<std::size_t>(c)) * warp_group_px + i];
      to[0] = root_of(left * sample.factor * read(picture_.blend, sample.mask, c) / max_factor_);
      to[std::size_t{3} * warp_group_px] = root_of(lift);
    }
  }

  void fill_group(std::size_t group, std::span<const MeshSample> samples, LightTiles& tiles) {
    const auto width = static_cast<float>(tiles.width(0));
    const auto height = static_cast<float>(tiles.height(0));
    std::size_t lit[warp_group_px];
    float x[warp_group_px];
    float y[warp_group_px];
    std::size_t count = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      MeshSample sample = samples[i];
      // The rim of the domemaster must not be repeated beyond it.
      if (!(sample.source[0] >= 0.0F && sample.source[0] <= 1.0F && sample.source[1] >= 0.0F &&
            sample.source[1] <= 1.0F)) {
        sample.factor = 0.0F;
      }
      set_factors(group, i, sample);
      if (sample.factor > 0.0F) {
        lit[count] = i;
        x[count] = sample.source[0] * width - 0.5F;
        y[count] = sample.source[1] * height - 0.5F;
        ++count;
      }
    }
    if (count == 0) {
      return;
    }
    const Lattice across(std::span(x, count));
    const Lattice down(std::span(y, count));
    WarpGroup& to = warp_.groups_.data()[group];
    to = {across.first, down.first, across.step, down.step, 0, 0};
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t at = group * warp_group_px + lit[k];
      const std::uint8_t level = level_of(samples[lit[k]]);
      warp_.x_.data()[at] = across.number(x[k]);
      warp_.y_.data()[at] = down.number(y[k]);
      warp_.level_.data()[at] = level;
      const int bit = 1 << (level / warp_level_steps);
      to.levels = static_cast<std::uint16_t>(to.levels | bit);
      if (level % warp_level_steps != 0) {
        to.blended = static_cast<std::uint16_t>(to.blended | bit);
      }
    }
    want(to, tiles);
  }

  //! Marks as needed all texels that a group's pixels read.
  static void want(const WarpGroup& group, LightTiles& tiles) {
    for (int level = 0; level < tiles.level_count(); ++level) {
      const bool finer = level > 0 && ((group.blended >> static_cast<unsigned>(level - 1)) & 1U) != 0;
      const bool own = ((group.levels >> static_cast<unsigned>(level)) & 1U) != 0;
      if (!own && !finer) {
        continue;
      }
      const float wide = static_cast<float>(tiles.width(level)) / static_cast<float>(tiles.width(0));
      const float high = static_cast<float>(tiles.height(level)) / static_cast<float>(tiles.height(0));
      const auto texel = [](float position, float scale) {
        return static_cast<int>(std::floor((position + 0.5F) * scale - 0.5F));
      };
      // With a margin, because pixels interpolate between neighboring texels.
      tiles.want(level, texel(group.x, wide) - 1, texel(group.x + full_scale * group.step_x, wide) + 2,
                 texel(group.y, high) - 1, texel(group.y + full_scale * group.step_y, high) + 2);
    }
  }

  ProjectorWarp& warp_;
  const ProjectorPicture& picture_;
  float max_factor_;
  std::mutex mutex_;
};

ProjectorWarp::ProjectorWarp(const ProjectorPicture& picture, int master_width, int master_height, Backend backend)
    : width_px_(picture.width_px),
      height_px_(picture.height_px),
      coloured_(picture.blend.channels == 3 || picture.black_level.width > 0),
      exponent_(static_cast<float>(1.0 / picture.gamma)),
      tiles_(master_width, master_height) {
  float max_intensity = 1e-6F;
  for (const WarpNode& node : picture.warp.nodes) {
    max_intensity = std::max(max_intensity, node.valid ? node.intensity : 0.0F);
  }
  const float max_factor = max_intensity * largest(picture.blend.values);
  for (int c = 0; c < 3; ++c) {
    const float gain = channel_of(picture.gain, c);
    const float lift = channel_of(picture.black_level_lift, c);
    factor_scale_[c] = gain * max_factor * (coloured_ ? 1.0F : 1.0F - lift) / (full_scale * full_scale);
    lift_scale_[c] = gain * lift / (coloured_ ? full_scale * full_scale : 1.0F);
  }
  const std::size_t groups = static_cast<std::size_t>(warp_groups(width_px_)) * static_cast<std::size_t>(height_px_);
  groups_ = zeros<WarpGroup>(groups);
  x_ = zeros<std::uint16_t>(groups * warp_group_px);
  y_ = zeros<std::uint16_t>(groups * warp_group_px);
  level_ = zeros<std::uint8_t>(groups * warp_group_px);
  factor_ = zeros<std::uint16_t>(groups * warp_group_px * (coloured_ ? 6 : 1));
  const MeshRaster raster(projector_mesh(picture.warp, picture.offsets), width_px_, height_px_);
  Builder builder(*this, picture, max_factor);
  parallel_for(raster.band_count(), 1, [&](int begin, int end) {
    for (int band = begin; band < end; ++band) {
      builder.fill(band * MeshRaster::band_rows, raster.band(band));
    }
  });
  move_to(backend);
}

void ProjectorWarp::move_to(Backend backend) {
  if (backend == backend_) {
    return;
  }
  backend_ = backend;
  move_there(backend, groups_);
  move_there(backend, x_);
  move_there(backend, y_);
  move_there(backend, level_);
  move_there(backend, factor_);
}

WarpBatch ProjectorWarp::batch(const LightLevels& light, float shown, std::uint8_t* rgb) const {
  WarpBatch batch{};
  batch.light = light;
  batch.width_px = width_px_;
  batch.height_px = height_px_;
  batch.groups = groups_.data();
  batch.x = x_.data();
  batch.y = y_.data();
  batch.level = level_.data();
  batch.factor = factor_.data();
  batch.coloured = coloured_;
  std::ranges::transform(factor_scale_, batch.factor_scale, [&](float scale) { return shown * scale; });
  std::ranges::copy(lift_scale_, batch.lift_scale);
  batch.exponent = exponent_;
  batch.minimum = std::exp2(-100.0F / std::max(exponent_, 1.0F));
  batch.rgb = rgb;
  return batch;
}

}  // namespace ergodome
