#include "render/patterns/setup_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "kernels/core/angles.h"
#include "kernels/projection/make_projection.h"
#include "render/patterns/dome_label.h"
#include "render/patterns/pattern_position.h"

namespace ergodome {

namespace {

constexpr double raster_lines = 16.0;

constexpr Vector3<float> colours[] = {{0.9F, 0.15F, 0.1F},  {0.1F, 0.5F, 1.0F}, {0.2F, 0.75F, 0.15F},
                                      {0.95F, 0.6F, 0.05F}, {0.6F, 0.2F, 0.9F}, {0.0F, 0.7F, 0.7F},
                                      {0.9F, 0.3F, 0.6F},   {0.5F, 0.5F, 0.4F}};

//! Returns the first channel of a mask at a position of the raster; 1 without a mask.
float mask_at(const BlendMap& mask, const WarpNode& position) {
  if (mask.width == 0) {
    return 1.0F;
  }
  const int column = std::min(static_cast<int>(position.u * static_cast<float>(mask.width)), mask.width - 1);
  const int row = std::min(static_cast<int>(position.v * static_cast<float>(mask.height)), mask.height - 1);
  const std::size_t sample =
      static_cast<std::size_t>(row) * static_cast<std::size_t>(mask.width) + static_cast<std::size_t>(column);
  return mask.values[sample * static_cast<std::size_t>(mask.channels)];
}

//! Inverts a warp: returns a mesh with the raster position for each of size x size pixels of the
//! domemaster. Nodes that the warp does not reach, outside the raster, or without light (intensity
//! times mask) are invalid.
WarpMesh raster_of_master(const ProjectorPicture& picture, int size_px) {
  WarpMesh turned = picture.warp;
  for (WarpNode& node : turned.nodes) {
    std::swap(node.x, node.u);
    std::swap(node.y, node.v);
  }
  WarpMesh raster = resampled_warp(turned, size_px, size_px);
  for (WarpNode& node : raster.nodes) {
    node.valid = node.valid && node.u >= 0.0F && node.u <= 1.0F && node.v >= 0.0F && node.v <= 1.0F &&
                 node.intensity * mask_at(picture.blend, node) > 0.0F;
  }
  return raster;
}

//! Returns the fraction of a pixel of the domemaster that is covered by lines at sixteenths of the
//! raster's width and height.
double raster_line(const WarpMesh& raster, int column, int row) {
  const WarpNode& here = raster.at(column, row);
  const WarpNode& right = raster.at(std::min(column + 1, raster.columns - 1), row);
  const WarpNode& below = raster.at(column, std::min(row + 1, raster.rows - 1));
  if (!right.valid || !below.valid) {
    return 0.0;
  }
  const auto change = [](float at, float across, float down) {
    return std::hypot(static_cast<double>(across - at), static_cast<double>(down - at));
  };
  const double spacing = 1.0 / raster_lines;
  return std::max(line_at(static_cast<double>(here.u), spacing, change(here.u, right.u, below.u), 1.0),
                  line_at(static_cast<double>(here.v), spacing, change(here.v, right.v, below.v), 1.0));
}

//! Returns labels with the projectors' numbers at the middle of their rasters; none for a projector
//! that lights no part of the dome within a tenth of its raster from the middle.
std::vector<DomeLabel> numbers_of(const std::vector<WarpMesh>& rasters, const Projection& projection) {
  std::vector<DomeLabel> labels;
  for (std::size_t i = 0; i < rasters.size(); ++i) {
    const WarpMesh& raster = rasters[i];
    double nearest = 0.1;
    DomeLabel label = {fmt::format("{}", i + 1), 0.0, 0.0, 10.0, {1.0F, 1.0F, 1.0F}};
    for (int row = 0; row < raster.rows; ++row) {
      for (int column = 0; column < raster.columns; ++column) {
        const WarpNode& node = raster.at(column, row);
        const double off = std::hypot(static_cast<double>(node.u) - 0.5, static_cast<double>(node.v) - 0.5);
        if (node.valid && off < nearest) {
          nearest = off;
          const PatternPosition position = pattern_position(projection, column + 0.5, row + 0.5);
          label.azimuth_deg = position.azimuth_deg;
          label.elevation_deg = position.elevation_deg;
        }
      }
    }
    if (nearest < 0.1) {
      labels.push_back(label);
    }
  }
  return labels;
}

Vector3<float> grid_on_black(const Projection& projection, const PatternPosition& position) {
  const DomeSteps steps = dome_steps(projection, position);
  const double spacing_deg = std::abs(position.elevation_deg) > 75.0 ? 90.0 : 30.0;
  const auto light =
      static_cast<float>(0.15 * std::max(line_at(position.elevation_deg, 30.0, steps.elevation_deg, 1.2),
                                         line_at(position.azimuth_deg, spacing_deg, steps.azimuth_deg, 1.2)));
  return {light, light, light};
}

std::vector<WarpMesh> rasters_of(const std::vector<ProjectorPicture>& pictures, int size_px) {
  std::vector<WarpMesh> rasters;
  rasters.reserve(pictures.size());
  for (const ProjectorPicture& picture : pictures) {
    rasters.push_back(raster_of_master(picture, size_px));
  }
  return rasters;
}

}  // namespace

std::vector<double> lit_parts(const std::vector<ProjectorPicture>& pictures) {
  constexpr int size_px = 256;
  const Projection projection = make_dome_projection(size_px, pi, 0.0);
  const std::vector<WarpMesh> rasters = rasters_of(pictures, size_px);
  // Weights pixels by their solid angle on the dome.
  std::vector<double> lit(pictures.size() + 1, 0.0);
  double all = 0.0;
  for (int row = 0; row < size_px; ++row) {
    for (int column = 0; column < size_px; ++column) {
      const double area =
          image_coverage(projection, column + 0.5, row + 0.5) * pixel_solid_angle(projection, column + 0.5, row + 0.5);
      all += area;
      bool dark = true;
      for (std::size_t i = 0; i < pictures.size(); ++i) {
        if (rasters[i].at(column, row).valid) {
          lit[i] += area;
          dark = false;
        }
      }
      lit.back() += dark ? area : 0.0;
    }
  }
  for (double& part : lit) {
    part /= all;
  }
  return lit;
}

Picture draw_setup(const std::vector<ProjectorPicture>& pictures, int size_px) {
  const Projection projection = make_dome_projection(size_px, pi, 0.0);
  const std::vector<WarpMesh> rasters = rasters_of(pictures, size_px);
  const std::vector<LabelStamp> numbers = stamps_of(numbers_of(rasters, projection));
  return draw_pattern(projection, 1, [&](const PatternPosition& position) {
    const int column = static_cast<int>(position.x_px);
    const int row = static_cast<int>(position.y_px);
    Vector3<float> light = {0.0F, 0.0F, 0.0F};
    bool dark = true;
    for (std::size_t i = 0; i < rasters.size(); ++i) {
      const WarpNode& node = rasters[i].at(column, row);
      if (node.valid) {
        const Vector3<float>& colour = colours[i % std::size(colours)];
        const float part = std::clamp(node.intensity * mask_at(pictures[i].blend, node), 0.0F, 1.0F);
        const auto line = static_cast<float>(raster_line(rasters[i], column, row));
        light = light + (0.08F + 0.5F * part + 0.3F * line) * colour;
        dark = false;
      }
    }
    return labelled(dark ? grid_on_black(projection, position) : light, numbers, position.direction);
  });
}

}  // namespace ergodome
