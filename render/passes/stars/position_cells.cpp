#include "render/passes/stars/position_cells.h"

#include <algorithm>

#include "kernels/launch/background_work.h"

namespace ergodome {

namespace {

//! Cells that are kept: one for each eye, and the next one.
constexpr std::size_t max_cells = max_eyes + 1;

//! Returns an eye in the middle of the cell of a position; nothing where there is no cell.
std::optional<StarEye> eye_in_cell(const StarEye& eye, const LensPosition& position) {
  const std::optional<LensPosition> middle = cell_middle(eye.camera.spacetime, position);
  if (!middle) {
    return std::nullopt;
  }
  StarEye there = eye;
  there.camera.r = there.camera.head_r = middle->r;
  there.camera.theta = there.camera.head_theta = middle->theta;
  return there;
}

}  // namespace

std::optional<StarEye> cell_of(const StarEye& eye, const CameraCourse& course) {
  if (!course.slow || eye.omni) {
    return std::nullopt;
  }
  return eye_in_cell(eye, {eye.camera.r, eye.camera.theta});
}

bool PositionCells::Key::serves(const StarEye& middle, const StarSettings& asked) const {
  return serves_pixel(settings.pixel, asked.pixel, asked.about) && settings.min_cell_px == asked.min_cell_px &&
         settings.faintest == asked.faintest && served_alike(eye, middle);
}

bool PositionCells::is_known(const StarEye& middle, const StarSettings& asked) const {
  return std::ranges::any_of(cells_, [&](const Cell& each) { return each.key.serves(middle, asked); });
}

const MovingPatches& PositionCells::patches(const StarEye& middle, const StarSettings& asked) {
  const bool finished = building_.valid() && building_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
  if (finished || (next_ && next_->serves(middle, asked) && !is_known(middle, asked))) {
    wait();
  }
  const auto known = std::ranges::find_if(cells_, [&](const Cell& each) { return each.key.serves(middle, asked); });
  if (known != cells_.end()) {
    std::rotate(cells_.begin(), known, known + 1);
  } else {
    keep(built({middle, asked}, take_room()));
  }
  return cells_.front().patches;
}

void PositionCells::prepare_next(const StarEye& eye, const StarSettings& asked) {
  // A cell takes about as long as six pictures of a dome.
  constexpr int pictures_ahead = 30;
  if (building_.valid() || !asked.course.step) {
    return;
  }
  const LensPosition step = *asked.course.step;
  const std::optional<StarEye> here = eye_in_cell(eye, {eye.camera.r, eye.camera.theta});
  for (int i = 1; i <= pictures_ahead; ++i) {
    const std::optional<StarEye> there =
        eye_in_cell(eye, {eye.camera.r + i * step.r, eye.camera.theta + i * step.theta});
    if (!here || !there) {
      return;
    }
    if (!served_alike(*here, *there)) {
      if (!is_known(*there, asked)) {
        next_.emplace(Key{*there, asked});
        building_ = std::async(std::launch::async, [this, key = *next_, room = take_room()]() mutable {
          const BackgroundWork background;
          return built(std::move(key), std::move(room));
        });
      }
      return;
    }
  }
}

void PositionCells::wait() {
  if (building_.valid()) {
    next_.reset();
    keep(building_.get());
  }
}

PositionCells::Cell PositionCells::built(Key key, MotionRoom room) const {
  MovingPatches patches = build_(key.eye, key.settings, room);
  return {std::move(key), std::move(patches), std::move(room.patches.parts)};
}

MotionRoom PositionCells::take_room() {
  MotionRoom room;
  if (cells_.size() >= max_cells) {
    room = std::move(cells_.back().patches).given_up();
    cells_.pop_back();
  }
  room.patches.parts = std::move(parts_);
  return room;
}

void PositionCells::keep(Cell cell) {
  parts_ = std::move(cell.parts);
  cells_.insert(cells_.begin(), std::move(cell));
}

}  // namespace ergodome
