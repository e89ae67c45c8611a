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

  //! What is to be loaded: a show that runs, or another version of it.
  struct Order {
    Show show;
    bool version = false;
  };

  //! A renderer, or why there is none, of what was ordered.
  struct Loaded {
    std::shared_ptr<ShowRenderer> renderer;
    std::string problem;
    Order order;
  };

  //! `make` may throw; it is called in other threads, once at a time.
  explicit RendererLoader(Make make) : make_(std::move(make)) {}

  //! Begins to load a show, after what is being loaded. Only the latest that waits counts.
  void load(Order order);

  //! What was loaded since the last call; nothing while it is in work.
  [[nodiscard]] std::optional<Loaded> take();

  [[nodiscard]] bool busy() const { return work_.valid() || next_.has_value(); }
  //! Whether what take() will give next is another version of a show.
  [[nodiscard]] bool loads_version() const { return next_ ? next_->version : work_.valid() && version_; }

 private:
  void begin(Order order);

  Make make_;
  std::future<Loaded> work_;
  bool version_ = false;  //!< is in work
  std::optional<Order> next_;
};

}  // namespace ergodome
