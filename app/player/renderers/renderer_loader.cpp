#include "app/player/renderers/renderer_loader.h"

#include <chrono>
#include <exception>
#include <utility>

namespace ergodome {

void RendererLoader::begin(Order order) {
  version_ = order.version;
  work_ = std::async(std::launch::async, [make = make_, order = std::move(order)]() -> Loaded {
    try {
      return {make(order.show), "", order};
    } catch (const std::exception& problem) {
      return {nullptr, problem.what(), order};
    }
  });
}

void RendererLoader::load(Order order) {
  if (work_.valid()) {
    next_ = std::move(order);
  } else {
    begin(std::move(order));
  }
}

std::optional<RendererLoader::Loaded> RendererLoader::take() {
  if (!work_.valid() || work_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
    return std::nullopt;
  }
  Loaded loaded = work_.get();
  if (next_) {
    // A later request replaces an earlier one.
    begin(*std::exchange(next_, std::nullopt));
    return std::nullopt;
  }
  return loaded;
}

}  // namespace ergodome
