#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "render/passes/pass.h"

namespace ergodome {

//! The passes that a show needs at some time, in the order of frame_passes().
class ShowPasses {
 public:
  //! Throws Error if a file that a pass draws cannot be read.
  explicit ShowPasses(const PassInput& input);

  //! Returns the passes that draw into eyes' pictures with the show's current numbers: those of all
  //! stages but PassStage::frame.
  [[nodiscard]] std::vector<Pass*> of_pictures(const Show& show, ViewMode mode) const;

  //! Draws the passes of PassStage::frame over the finished pictures of a frame.
  void finish(FinishedFrame& frame) const;

  //! Returns the pass of type T, or nullptr if the show has none.
  template <class T>
  [[nodiscard]] T* find() const {
    for (const std::unique_ptr<Pass>& pass : passes_) {
      if (auto* const found = dynamic_cast<T*>(pass.get())) {
        return found;
      }
    }
    return nullptr;
  }

  void apply(const Show& show, const NumberChange& change);
  [[nodiscard]] std::vector<std::string> notes(const Show& show) const;

  //! New passes for another show, by index in frame_passes(). An entry is empty if the current pass
  //! can draw the other show, and holds null if that show does not need the pass.
  using Change = std::vector<std::optional<std::unique_ptr<Pass>>>;

  //! Creates those passes for another show (`input.show`) that replace current passes which cannot
  //! draw it. Throws Error like the constructor. Changes nothing in this object.
  [[nodiscard]] Change changed_for(const Show& now, PassInput input) const;
  void replace(Change change);

 private:
  std::vector<std::unique_ptr<Pass>> passes_;  //!< one for each of frame_passes(); null if not needed
};

}  // namespace ergodome
