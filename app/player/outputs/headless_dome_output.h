#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibration/projectors/projector_picture.h"
#include "render/present/output.h"
#include "render/present/projectors/headless_projectors.h"

namespace ergodome {

//! The projectors of a dome without windows: their images are drawn on the CPU, into memory.
class HeadlessDomeOutput : public DisplayOutput {
 public:
  explicit HeadlessDomeOutput(const std::vector<ProjectorPicture>& pictures);

  [[nodiscard]] OutputWish wish() override { return {}; }
  void take(OutputFrame& frame) override { picture_ = frame.picture; }
  void set_light(double /*light*/) override {}
  void show() override;
  [[nodiscard]] bool closed() const override { return closed_; }
  void close() override { closed_ = true; }
  [[nodiscard]] bool is_dome() const override { return true; }
  void set_projectors(const std::vector<ProjectorPicture>& pictures) override;
  void set_rasters(const std::vector<Picture>& rasters) override { rasters_ = rasters; }
  [[nodiscard]] std::string join_swap_group(bool joined) override;

  //! Returns the fingerprint of the images that are shown.
  [[nodiscard]] const std::string& images() const { return images_; }

 private:
  std::size_t count_ = 0;
  std::optional<HeadlessProjectors> projectors_;
  std::vector<Picture> rasters_;
  Picture picture_;
  std::string images_;
  bool closed_ = false;
};

}  // namespace ergodome
