#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "render/present/projector_warp.h"

namespace ergodome {

//! Draws what the projectors of a dome show on the processor: several times as fast as OpenGL in software, and without a driver.
class SoftwareProjectors {
 public:
  explicit SoftwareProjectors(std::vector<ProjectorPicture> pictures) : pictures_(std::move(pictures)) {}

  //! Takes over a domemaster, in linear light; it stays until the next one. The first, and one of another size, takes longer.
  void show(const Picture& master, float dimmed = 1.0F);

  //! Takes over a projector's picture; the next master shows it.
  void replace(std::size_t projector, const ProjectorPicture& picture);

  //! What a projector shows of the master: the values that it is sent, RGB bytes of its resolution, the top row first.
  [[nodiscard]] std::vector<std::uint8_t> frame(std::size_t projector) const;

  //! The same, into memory of that size.
  void frame(std::size_t projector, std::uint8_t* rgb) const { warps_[projector]->draw(light_.levels(), rgb); }

  [[nodiscard]] const ProjectorPicture& picture(std::size_t projector) const { return pictures_[projector]; }

 private:
  //! Works out warps that are missing, or all for another size.
  void prepare(int width, int height);

  std::vector<ProjectorPicture> pictures_;
  std::vector<std::optional<ProjectorWarp>> warps_;
  MasterLight light_;
};

}  // namespace ergodome
