#pragma once

#include <cstdint>
#include <vector>

#include "kernels/image/light_levels.h"
#include "render/backend/buffer.h"
#include "render/picture/picture.h"

// Light of a domemaster for projectors, computed with kernels.

namespace ergodome {

//! The parts of a master's light that are wanted, by level.
class LightTiles {
 public:
  //! Starts empty, for a master of this size.
  LightTiles(int width, int height);

  [[nodiscard]] int level_count() const { return static_cast<int>(levels_.size()); }
  [[nodiscard]] int width(int level) const { return levels_[static_cast<std::size_t>(level)].width; }
  [[nodiscard]] int height(int level) const { return levels_[static_cast<std::size_t>(level)].height; }

  //! Marks texels of a level as wanted, both ends included; ignores texels outside the level.
  void want(int level, int left, int right, int top, int bottom);

  //! Adds the wanted parts of another set of the same size.
  void join(const LightTiles& other);

  //! Adds everything that the wanted parts are averaged from.
  void complete();

  //! Returns the wanted tiles of a level.
  [[nodiscard]] std::vector<std::int32_t> tiles(int level) const;

 private:
  struct Level {
    int width;
    int height;
    std::vector<std::uint8_t> wanted;  //!< by tile
  };
  std::vector<Level> levels_;
};

//! A domemaster in a backend's memory: linear light, four floats per pixel, top row first.
struct MasterPicture {
  const float* rgba = nullptr;
  int width = 0;
  int height = 0;
  bool heat_map = false;  //!< the values are colors and get no tone
  Tone tone;
};

//! Returns a view of a picture in host memory, valid while the picture exists.
MasterPicture master_picture(const Picture& picture);

//! Computes a domemaster's light for projectors with kernels, as DisplayLight does with OpenGL, but
//! only where it is wanted.
class MasterLight {
 public:
  MasterLight() = default;

  //! Allocates memory of a backend. `tiles` must be complete.
  MasterLight(const LightTiles& tiles, Backend backend);

  //! Computes the light of a picture in the same backend's memory, with the size that the tiles
  //! were made for. Does not wait for a GPU.
  void update(const MasterPicture& picture);

  [[nodiscard]] const LightLevels& levels() const { return levels_; }

 private:
  Backend backend_ = Backend::cpu;
  LightLevels levels_{};
  std::vector<Buffer<float>> memory_;
  std::vector<Buffer<std::int32_t>> tiles_;
};

}  // namespace ergodome
