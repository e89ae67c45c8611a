#pragma once

#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <string>

#include "render/frame/show_renderer.h"

namespace ergodome {

//! Makes renderers of shows on another thread: skies take a second to load, and the window must not
//! wait.
class RendererLoader {
 public:
  using Make = std::function<std::shared_ptr<ShowRenderer>(const Show&)>;

  //! A show to load: one that is about to run or, if `version`, a new version of the running one.
  struct Order {
    Show show;
    bool version = false;
  };

  //! The result of an order: a renderer, or why there is none.
  struct Loaded {
    std::shared_ptr<ShowRenderer> renderer;
    std::string problem;
    Order order;
  };

  //! `make` may throw. It is called in other threads, one call at a time.
  explicit RendererLoader(Make make) : make_(std::move(make)) {}

  //! Starts to load a show after the current load. Of waiting orders, only the latest is kept.
  void load(Order order);

  //! Returns the result of a load that finished since the last call. Returns nothing while loading.
  //! If another order waits, discards the result and starts to load that order.
  [[nodiscard]] std::optional<Loaded> take();

  [[nodiscard]] bool busy() const { return work_.valid() || next_.has_value(); }
  //! Returns whether the next result of take() is a new version of the running show.
  [[nodiscard]] bool loads_version() const { return next_ ? next_->version : work_.valid() && version_; }

 private:
  void begin(Order order);

  Make make_;
  std::future<Loaded> work_;
  bool version_ = false;  //!< the current load is a new version of the running show
  std::optional<Order> next_;
};

}  // namespace ergodome
