#pragma once

#include <functional>
#include <future>
#include <optional>
#include <utility>
#include <vector>

#include "render/passes/stars/search/moving_patches.h"
#include "render/passes/stars/search/star_finder.h"
#include "render/passes/stars/star_eye.h"

namespace ergodome {

//! Returns the eye in the middle of the cell whose patches are moved for `eye`; nothing if a grid
//! is built for its own position.
std::optional<StarEye> cell_of(const StarEye& eye, const CameraCourse& course);

//! Caches the patches of the cells in which the last eyes were, and builds those of the next cell
//! in the background.
class PositionCells {
 public:
  //! Builds the patches of a cell for an eye in its middle, in reused memory. Called on any thread.
  using Build = std::function<MovingPatches(const StarEye&, const StarSettings&, MotionRoom&)>;

  explicit PositionCells(Build build) : build_(std::move(build)) {}
  // The background thread refers to this object.
  PositionCells(const PositionCells&) = delete;
  PositionCells& operator=(const PositionCells&) = delete;

  //! Returns the patches of the cell of `middle`, the result of cell_of(). The reference is valid
  //! until the next call.
  const MovingPatches& patches(const StarEye& middle, const StarSettings& asked);

  //! Starts to build the next cell of an eye in the background, if CameraCourse::step shows that the
  //! eye reaches it within 30 pictures.
  void prepare_next(const StarEye& eye, const StarSettings& asked);

  //! Waits for the cell that is being built. Call it before data changes that Build reads.
  void wait();

 private:
  //! Parameters for which the patches of a cell are computed.
  struct Key {
    StarEye eye;  //!< in the middle of the cell
    StarSettings settings;

    [[nodiscard]] bool serves(const StarEye& middle, const StarSettings& asked) const;
  };

  struct Cell {
    Key key;
    MovingPatches patches;
    std::vector<std::vector<StarPatch>> parts;  //!< memory for the next call of Build
  };

  [[nodiscard]] bool is_known(const StarEye& middle, const StarSettings& asked) const;
  [[nodiscard]] Cell built(Key key, MotionRoom room) const;
  MotionRoom take_room();
  void keep(Cell cell);

  Build build_;
  std::vector<Cell> cells_;  //!< cells of the last eyes, most recent first
  std::vector<std::vector<StarPatch>> parts_;
  std::optional<Key> next_;  //!< of the cell that is being built
  std::future<Cell> building_;
};

}  // namespace ergodome
