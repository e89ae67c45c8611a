#include "app/player/node_calibration.h"

#include <utility>

#include "app/cli/setup_show.h"
#include "kernels/core/error.h"
#include "render/patterns/test_pattern.h"

namespace ergodome {

NodeCalibration::NodeCalibration(DomeSetup setup, std::string node) : read_(std::move(setup)), setup_(read_) {
  for (std::size_t i = 0; i < read_.projectors.size(); ++i) {
    if (read_.projectors[i].node == node) {
      own_.push_back(i);
    }
  }
}

bool NodeCalibration::follow(const ClusterFrame& frame, const std::optional<ClusterCalibration>& calibration) {
  if (frame.calibration == version_) {
    return false;
  }
  if (frame.calibration == 0) {
    version_ = 0;
    setup_ = read_;
    texts_.clear();
    text_.clear();
    pictures_.emplace(read_);
    return true;
  }
  if (!calibration || calibration->version != frame.calibration) {
    return false;
  }
  // Each version is tried once.
  version_ = frame.calibration;
  DomeSetup setup =
      parse_dome_setup(calibration->setup, (read_.folder / "setup of the master").string(), NamedFiles::unchecked);
  if (setup.projectors.size() != read_.projectors.size() || calibration->offsets.size() != setup.projectors.size()) {
    throw Error("calibration", "the master has another number of projectors", "copy the setup file of the master");
  }
  texts_.clear();
  for (const std::size_t i : own_) {
    texts_.push_back(i < calibration->texts.size() ? calibration->texts[i] : std::string());
  }
  if (pictures_ && calibration->setup == text_ && calibration->offsets == offsets_) {
    return false;
  }
  if (!pictures_) {
    pictures_.emplace(read_, MaskDetail::preview);
  }
  text_ = calibration->setup;
  offsets_ = calibration->offsets;
  pictures_->follow(setup, calibration->offsets);
  setup_ = std::move(setup);
  return true;
}

std::vector<ProjectorPicture> NodeCalibration::pictures() const {
  std::vector<ProjectorPicture> own;
  own.reserve(own_.size());
  for (const std::size_t i : own_) {
    own.push_back(pictures_->pictures()[i]);
  }
  return own;
}

bool NodeCalibration::rasters_change(const ClusterFrame& frame) {
  const bool numbers = frame.pattern == ClusterPattern::projector_numbers;
  return std::exchange(numbers_, numbers) != numbers;
}

std::vector<Picture> NodeCalibration::rasters(const ClusterFrame& frame) const {
  std::vector<Picture> rasters;
  if (frame.pattern == ClusterPattern::projector_numbers) {
    for (const std::size_t i : own_) {
      const ProjectorSetup& projector = read_.projectors[i];
      rasters.push_back(
          draw_projector_number(static_cast<int>(i) + 1, projector.name, projector.width_px, projector.height_px));
    }
  }
  return rasters;
}

std::function<Picture(int)> NodeCalibration::pattern_of(const ClusterFrame& frame) const {
  if (frame.pattern == ClusterPattern::none) {
    return {};
  }
  const auto count = static_cast<int>(test_pattern_names().size());
  const bool known = frame.pattern == ClusterPattern::test_pattern && frame.pattern_kind < count;
  const TestPattern pattern = known ? static_cast<TestPattern>(frame.pattern_kind) : TestPattern::black;
  return [pattern, setup = setup_](int size_px) { return draw_test_pattern(pattern, upright_master(setup, size_px)); };
}

}  // namespace ergodome
