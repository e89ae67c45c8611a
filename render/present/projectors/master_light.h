#pragma once

#include <cstdint>
#include <vector>

#include "kernels/image/light_levels.h"
#include "render/backend/buffer.h"
#include "render/frame/eye_renderer.h"

namespace ergodome {

//! Which parts of a master's light are wanted, by levels.
class LightTiles {
 public:
  //! None yet, of a master of this size.
  LightTiles(int width, int height);

  [[nodiscard]] int level_count() const { return static_cast<int>(levels_.size()); }
  [[nodiscard]] int width(int level) const { return levels_[static_cast<std::size_t>(level)].width; }
  [[nodiscard]] int height(int level) const { return levels_[static_cast<std::size_t>(level)].height; }

  //! Wants texels of a level, both ends included; what is outside it is left out.
  void want(int level, int left, int right, int top, int bottom);

  //! Wants what another of the same size wants.
  void join(const LightTiles& other);

  //! Wants what the wanted parts are averaged from.
  void complete();

  //! The wanted tiles of a level.
  [[nodiscard]] std::vector<std::int32_t> tiles(int level) const;

 private:
  struct Level {
    int width;
    int height;
    std::vector<std::uint8_t> wanted;  //!< by tiles
  };
  std::vector<Level> levels_;
};

//! A domemaster in a backend's memory: linear light, four floats a pixel, the top row first.
struct MasterPicture {
  const float* rgba = nullptr;
  int width = 0;
  int height = 0;
  bool heat_map = false;  //!< colours already, to which no tone is given
  Tone tone;
};

//! The same in host memory, as long as the picture is there.
MasterPicture master_picture(const Picture& picture);

//! A domemaster as light for projectors, by kernels: what DisplayLight is by OpenGL, and where it is wanted alone.
class MasterLight {
 public:
  MasterLight() = default;

  //! Makes room in a backend's memory. `tiles` must be complete.
  MasterLight(const LightTiles& tiles, Backend backend);

  //! Makes the light of a picture of the size that the tiles are of, in the same backend's memory. A device is not waited for.
  void update(const MasterPicture& picture);

  [[nodiscard]] const LightLevels& levels() const { return levels_; }

 private:
  Backend backend_ = Backend::cpu;
  LightLevels levels_{};
  std::vector<Buffer<float>> memory_;
  std::vector<Buffer<std::int32_t>> tiles_;
};

}  // namespace ergodome
