#include "kernels/launch/launch_on_cuda.cuh"
#include "kernels/stars/draw_stars_kernel.h"

namespace ergodome {

namespace {

//! Number of points of a tile that a block holds in shared memory at a time.
constexpr int held_points = 64;
//! Maximum number of points of a tile that a block sorts in shared memory; one thread sorts longer
//! lists.
constexpr int held_numbers = 2048;

//! Sorts the points of a tile, one block per tile: each thread finds the ranks of some points by
//! counting smaller ones.
__global__ void sort_tiles(const __grid_constant__ SortTile functor) {
  __shared__ std::int32_t held[held_numbers];
  const StarTileBatch& batch = functor.batch;
  const int tile = static_cast<int>(blockIdx.x);
  const int count = batch.first[tile + 1] - batch.first[tile];
  if (count < 2) {
    return;
  }
  if (count > held_numbers) {
    if (threadIdx.x == 0) {
      functor(tile);
    }
    return;
  }
  std::int32_t* const list = batch.members + batch.first[tile];
  for (int i = static_cast<int>(threadIdx.x); i < count; i += static_cast<int>(blockDim.x)) {
    held[i] = list[i];
  }
  __syncthreads();
  for (int i = static_cast<int>(threadIdx.x); i < count; i += static_cast<int>(blockDim.x)) {
    int position = 0;
    for (int other = 0; other < count; ++other) {
      position += held[other] < held[i] || (held[other] == held[i] && other < i) ? 1 : 0;
    }
    list[position] = held[i];
  }
}

//! The tile of a block, and the pixel of a thread in it.
struct TileOfBlock {
  int x;
  int y;
  bool inside;
  //! Index in StarLightBatch::members of the tile's first point; `last`: one past its last point.
  int first;
  int last;

  __device__ explicit TileOfBlock(const StarLightBatch& batch) {
    const int column = static_cast<int>(blockIdx.x);
    const int row = batch.first_row / star_tile_px + static_cast<int>(blockIdx.y);
    const int tile = row * batch.tile_columns + column;
    first = batch.first[tile];
    last = batch.first[tile + 1];
    x = column * star_tile_px + static_cast<int>(threadIdx.x) % star_tile_px;
    y = row * star_tile_px + static_cast<int>(threadIdx.x) / star_tile_px;
    inside = x < batch.projection.width_px && y >= batch.first_row && y < batch.first_row + batch.row_count;
  }
};

//! Draws the spots of a tile, one block per tile, one thread per pixel. The fractions of each
//! spot's light on each column and on each row are computed once; a pixel uses their product.
__global__ void draw_spots(const __grid_constant__ DrawStars functor) {
  __shared__ float light_of[held_points][3];
  __shared__ float columns[held_points][star_tile_px];
  __shared__ float rows[held_points][star_tile_px];
  const StarLightBatch& batch = functor.batch;
  const TileOfBlock tile(batch);
  if (tile.first == tile.last) {
    return;
  }
  const int thread = static_cast<int>(threadIdx.x);
  const int column = thread % star_tile_px;
  const int row = thread / star_tile_px;
  const int left = tile.x - column;
  const int top = tile.y - row;
  float light[3] = {};
  for (int begin = tile.first; begin < tile.last; begin += held_points) {
    const int count = tile.last - begin < held_points ? tile.last - begin : held_points;
    __syncthreads();
    for (int i = row; i < count; i += star_tile_px) {
      const StarPoint& point = batch.points[batch.members[begin + i]];
      columns[i][column] = functor.part_of_column(point, left + column);
      rows[i][column] = functor.part_of_row(point, top + column);
      if (column < 3) {
        const float parts[3] = {point.light.x, point.light.y, point.light.z};
        light_of[i][column] = functor.counts_again(tile.first, begin + i) ? 0.0F : parts[column];
      }
    }
    __syncthreads();
    for (int i = 0; i < count; ++i) {
      const float part = columns[i][column] * rows[i][row];
      for (int channel = 0; channel < 3; ++channel) {
        light[channel] += part * light_of[i][channel];
      }
    }
  }
  if (tile.inside) {
    functor.lay(light, tile.x, tile.y);
  }
}

//! Draws the spikes of a tile, one block per tile, one thread per pixel.
__global__ void draw_spikes(const __grid_constant__ DrawStars functor) {
  const StarLightBatch& batch = functor.batch;
  const TileOfBlock tile(batch);
  if (tile.first == tile.last || !tile.inside) {
    return;
  }
  float light[3] = {};
  for (int i = tile.first; i < tile.last; ++i) {
    if (!functor.counts_again(tile.first, i)) {
      functor.add(batch.points[batch.members[i]], tile.x, tile.y, light);
    }
  }
  functor.lay(light, tile.x, tile.y);
}

}  // namespace

template <>
void launch_on_cuda(const StarTileBatch& batch) {
  if (batch.step != StarTileStep::sort) {
    return dispatch<float>(batch, [&](const auto& functor) {
      launch_cuda("place_stars", Kernel<StarTileBatch>::elements(batch), functor);
    });
  }
  sort_tiles<<<static_cast<unsigned>(batch.tile_count), 128, 0, current_stream()>>>(SortTile{batch});
  end_launch("place_stars");
}

template <>
void launch_on_cuda(const StarLightBatch& batch) {
  if (batch.row_count <= 0) {
    return;
  }
  const int rows = (batch.first_row + batch.row_count - 1) / star_tile_px - batch.first_row / star_tile_px + 1;
  const dim3 tiles(static_cast<unsigned>(batch.tile_columns), static_cast<unsigned>(rows));
  constexpr int pixels = star_tile_px * star_tile_px;
  if (batch.pattern != nullptr) {
    draw_spikes<<<tiles, pixels, 0, current_stream()>>>(DrawStars{batch});
  } else {
    draw_spots<<<tiles, pixels, 0, current_stream()>>>(DrawStars{batch});
  }
  end_launch("draw_stars");
}

}  // namespace ergodome
