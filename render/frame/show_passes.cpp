#include "render/frame/show_passes.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "render/frame/frame_passes.h"

namespace ergodome {

namespace {
std::unique_ptr<Pass> make_pass(const PassKind& kind, const PassInput& input) {
  return kind.make != nullptr ? kind.make(input) : nullptr;
}
}  // namespace

ShowPasses::ShowPasses(const PassInput& input) {
  for (const PassKind& kind : frame_passes()) {
    passes_.push_back(make_pass(kind, input));
  }
}

std::vector<Pass*> ShowPasses::of_pictures(const Show& show, ViewMode mode) const {
  std::vector<Pass*> needed;
  for (const std::unique_ptr<Pass>& pass : passes_) {
    if (pass && pass->kind().stage != PassStage::frame && pass->kind().draws(show, mode)) {
      needed.push_back(pass.get());
    }
  }
  return needed;
}

void ShowPasses::finish(FinishedFrame& frame) const {
  for (const std::unique_ptr<Pass>& pass : passes_) {
    if (pass && pass->kind().stage == PassStage::frame) {
      pass->finish_frame(frame);
    }
  }
}

void ShowPasses::apply(const Show& show, const NumberChange& change) {
  for (const std::unique_ptr<Pass>& pass : passes_) {
    if (pass) {
      pass->apply(show, change);
    }
  }
}

std::vector<std::string> ShowPasses::notes(const Show& show) const {
  std::vector<std::string> notes;
  for (const std::unique_ptr<Pass>& pass : passes_) {
    if (pass) {
      std::ranges::move(pass->notes(show), std::back_inserter(notes));
    }
  }
  return notes;
}

ShowPasses::Change ShowPasses::changed_for(const Show& now, PassInput input) const {
  Change change(passes_.size());
  for (std::size_t i = 0; i < passes_.size(); ++i) {
    if (!passes_[i] || !passes_[i]->serves(now, input.show)) {
      input.previous_show = &now;
      input.previous = passes_[i].get();
      change[i] = make_pass(frame_passes()[i], input);
    }
  }
  return change;
}

void ShowPasses::replace(Change change) {
  for (std::size_t i = 0; i < passes_.size(); ++i) {
    if (change[i] && !(passes_[i] && *change[i] && passes_[i]->take(**change[i]))) {
      passes_[i] = std::move(*change[i]);
    }
  }
}

}  // namespace ergodome
