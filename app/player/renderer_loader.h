#pragma once

#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <string>

#include "render/frame/show_renderer.h"

namespace ergodome {

//! Makes renderers of shows beside the player's thread: skies take a second to load, and the window must not wait.
class RendererLoader {
 public:
  using Make = std::function<std::shared_ptr<ShowRenderer>(const Show&)>;

  //! A renderer, or why there is none.
  struct Loaded {
    std::shared_ptr<ShowRenderer> renderer;
    std::string problem;
  };

  //! `make` may throw; it is called in other threads, once at a time.
  explicit RendererLoader(Make make) : make_(std::move(make)) {}

  //! Begins to load a show, after what is being loaded. Only the latest that waits counts.
  void load(Show show);

  //! What was loaded since the last call; nothing while it is in work.
  [[nodiscard]] std::optional<Loaded> take();

  [[nodiscard]] bool busy() const { return work_.valid() || next_.has_value(); }

 private:
  void begin(Show show);

  Make make_;
  std::future<Loaded> work_;
  std::optional<Show> next_;
};

}  // namespace ergodome
