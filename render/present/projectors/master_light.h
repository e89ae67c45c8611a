#pragma once

#include <cstdint>
#include <vector>

#include "kernels/image/light_levels.h"
#include "render/backend/buffer.h"
#include "render/picture/picture.h"

// Light of a domemaster for projectors, computed with kernels.

namespace ergodome {

//! The tiles of a domemaster, on each mip level, in which display light is needed.
class LightTiles {
 public:
  //! Creates an empty set for a domemaster of this size.
  LightTiles(int width, int height);

  [[nodiscard]] int level_count() const { return static_cast<int>(levels_.size()); }
  [[nodiscard]] int width(int level) const { return levels_[static_cast<std::size_t>(level)].width; }
  [[nodiscard]] int height(int level) const { return levels_[static_cast<std::size_t>(level)].height; }

  //! Marks texels of a level as needed, both ends included; ignores texels outside the level.
  void want(int level, int left, int right, int top, int bottom);

  //! Adds the needed tiles of another set, for a domemaster of the same size.
  void join(const LightTiles& other);

  //! Adds all tiles of finer levels from which the needed tiles are averaged.
  void complete();

  //! Returns the indices of the needed tiles of a level: row times tiles per row plus column.
  [[nodiscard]] std::vector<std::int32_t> tiles(int level) const;

 private:
  struct Level {
    int width;
    int height;
    std::vector<std::uint8_t> wanted;  //!< for each tile, whether it is needed
  };
  std::vector<Level> levels_;
};

//! A domemaster in a backend's memory: linear light, four floats per pixel, top row first.
struct MasterPicture {
  const float* rgba = nullptr;
  int width = 0;
  int height = 0;
  bool heat_map = false;  //!< true: values are display colors, to which no tone is applied
  Tone tone;
};

//! Returns a view of a picture in host memory, valid while the picture exists.
MasterPicture master_picture(const Picture& picture);

//! Computes a domemaster's display light for projectors with kernels, as DisplayLight does with
//! OpenGL, but only in the tiles in which it is needed.
class MasterLight {
 public:
  MasterLight() = default;

  //! Allocates memory of a backend. LightTiles::complete() must have been called for `tiles`.
  MasterLight(const LightTiles& tiles, Backend backend);

  //! Computes the light of a picture in the same backend's memory. The picture must have the size
  //! for which the tiles were created. Does not wait for a GPU.
  void update(const MasterPicture& picture);

  [[nodiscard]] const LightLevels& levels() const { return levels_; }

 private:
  Backend backend_ = Backend::cpu;
  LightLevels levels_{};
  std::vector<Buffer<float>> memory_;
  std::vector<Buffer<std::int32_t>> tiles_;
};

}  // namespace ergodome
