#include "calibration/warps/warp_conversion.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ergodome {

namespace {

constexpr float unknown_sample = std::numeric_limits<float>::quiet_NaN();

//! Maximum coordinate, far outside any image; the comparison also rejects NaN.
constexpr float largest_coordinate = 1e4F;

float directed(float v, TextureDirection direction) { return direction == TextureDirection::downwards ? v : 1.0F - v; }

//! Returns the node at parameter `t` on the line through `inner` (t = 0) and `outer` (t = 1),
//! linearly extrapolated for t > 1.
WarpNode continued(const WarpNode& inner, const WarpNode& outer, float t) {
  const auto along = [t](float from, float to) { return from + t * (to - from); };
  return {along(inner.x, outer.x),
          along(inner.y, outer.y),
          along(inner.u, outer.u),
          along(inner.v, outer.v),
          std::max(along(inner.intensity, outer.intensity), 0.0F),
          inner.valid && outer.valid};
}

//! Returns a mask's value (0 to 1, the mean of its channels) at a position of the raster,
//! interpolated between its samples.
double value_at(const BlendMap& mask, double x, double y) {
  const double column = std::clamp(x * mask.width - 0.5, 0.0, mask.width - 1.0);
  const double row = std::clamp(y * mask.height - 0.5, 0.0, mask.height - 1.0);
  const int left = std::min(static_cast<int>(column), mask.width - 2);
  const int top = std::min(static_cast<int>(row), mask.height - 2);
  const auto sample = [&](int i, int j) {
    const std::size_t first =
        static_cast<std::size_t>(mask.channels) *
        (static_cast<std::size_t>(j) * static_cast<std::size_t>(mask.width) + static_cast<std::size_t>(i));
    double sum = 0.0;
    for (int c = 0; c < mask.channels; ++c) {
      sum += mask.values[first + static_cast<std::size_t>(c)];
    }
    return sum / mask.channels;
  };
  return std::lerp(std::lerp(sample(left, top), sample(left + 1, top), column - left),
                   std::lerp(sample(left, top + 1), sample(left + 1, top + 1), column - left), row - top);
}

}  // namespace

WarpMesh warp_from_map(const FloatMap& map, TextureDirection direction) {
  WarpMesh mesh{MeshTopology::rectangular, map.width, map.height, {}};
  mesh.nodes.reserve(map.samples.size() / 3);
  const float* sample = map.samples.data();
  for (int row = 0; row < map.height; ++row) {
    for (int column = 0; column < map.width; ++column, sample += 3) {
      const bool valid = std::abs(sample[0]) <= largest_coordinate && std::abs(sample[1]) <= largest_coordinate;
      mesh.nodes.push_back({static_cast<float>(fill_position(column, map.width)),
                            static_cast<float>(fill_position(row, map.height)), valid ? sample[0] : 0.0F,
                            valid ? directed(sample[1], direction) : 0.0F, valid ? 1.0F : 0.0F, valid});
    }
  }
  return mesh;
}

FloatMap map_from_warp(const WarpMesh& mesh, int width, int height, TextureDirection direction) {
  const WarpMesh filled = resampled_warp(mesh, width, height);
  FloatMap map{width, height, {}};
  map.samples.reserve(3 * filled.nodes.size());
  for (const WarpNode& node : filled.nodes) {
    const float sample[] = {node.valid ? node.u : unknown_sample,
                            node.valid ? directed(node.v, direction) : unknown_sample,
                            node.valid ? 0.0F : unknown_sample};
    map.samples.insert(map.samples.end(), std::begin(sample), std::end(sample));
  }
  return map;
}

WarpMesh with_rim(const WarpMesh& mesh) {
  // The edge is half a step beyond the outermost sample, which is 1.5 steps from the sample before
  // it.
  constexpr float to_rim = 1.5F;
  WarpMesh wider{mesh.topology, mesh.columns + 2, mesh.rows, {}};
  for (int row = 0; row < mesh.rows; ++row) {
    wider.nodes.push_back(continued(mesh.at(1, row), mesh.at(0, row), to_rim));
    wider.nodes.insert(wider.nodes.end(), &mesh.at(0, row), &mesh.at(0, row) + mesh.columns);
    wider.nodes.push_back(continued(mesh.at(mesh.columns - 2, row), mesh.at(mesh.columns - 1, row), to_rim));
  }
  WarpMesh whole{mesh.topology, wider.columns, mesh.rows + 2, {}};
  const auto rim_row = [&](int inner, int outer) {
    for (int column = 0; column < wider.columns; ++column) {
      whole.nodes.push_back(continued(wider.at(column, inner), wider.at(column, outer), to_rim));
    }
  };
  rim_row(1, 0);
  whole.nodes.insert(whole.nodes.end(), wider.nodes.begin(), wider.nodes.end());
  rim_row(wider.rows - 2, wider.rows - 1);
  return whole;
}

BlendMap mask_from_warp(const WarpMesh& mesh, int width, int height) {
  const WarpMesh filled = resampled_warp(mesh, width, height);
  BlendMap mask{width, height, 1, 16, {}};
  mask.values.reserve(filled.nodes.size());
  for (const WarpNode& node : filled.nodes) {
    mask.values.push_back(node.valid ? std::clamp(node.intensity, 0.0F, 1.0F) : 0.0F);
  }
  return mask;
}

void multiply_intensity(WarpMesh& mesh, const BlendMap& mask, double gamma) {
  for (WarpNode& node : mesh.nodes) {
    node.intensity *= static_cast<float>(std::pow(value_at(mask, node.x, node.y), gamma));
  }
}

}  // namespace ergodome
