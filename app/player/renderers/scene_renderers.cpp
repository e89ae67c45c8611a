#include "app/player/renderers/scene_renderers.h"

#include <utility>

#include "app/cli/backend_choice.h"

namespace ergodome {

namespace {

//! Time between attempts to make a renderer: what fails now may succeed later, but not in the next
//! frame.
constexpr std::chrono::seconds patience{1};

bool is_same_file(const Show& a, const Show& b) { return a.name == b.name && a.folder == b.folder; }

}  // namespace

void SceneRenderers::use(std::shared_ptr<ShowRenderer> renderer) {
  current_ = std::move(renderer);
  if (current_) {
    backend_ = describe(current_->backend());
  }
}

void SceneRenderers::enter(ExhibitScene scene, const Show& show) {
  scene_ = scene;
  again_.reset();
  use(of_scenes_[scene]);
  if (!current_) {
    loader_.load({show});
  }
}

void SceneRenderers::lose(const Show& show) {
  current_.reset();
  of_scenes_[scene_].reset();
  if (!renews()) {
    loader_.load({show});
  }
}

SceneRenderers::News SceneRenderers::advance(const Show& show) {
  if (again_ && Clock::now() >= *again_) {
    again_.reset();
    if (!renews()) {
      loader_.load({show});
    }
  }
  auto loaded = loader_.take();
  if (!loaded) {
    return {};
  }
  RendererLoader::Order& order = loaded->order;
  // Discards a renderer that was loaded for a scene that has ended.
  const bool own = is_same_file(order.show, show);
  std::optional<Show> version;
  if (own && order.version) {
    version = std::move(order.show);
  }
  if (own && loaded->renderer) {
    if (version) {
      std::erase_if(of_scenes_, [&](const auto& of) { return of.second && is_same_file(of.second->show(), show); });
    }
    of_scenes_[scene_] = loaded->renderer;
    use(std::move(loaded->renderer));
    return {true, "", std::move(version)};
  }
  if (!current_) {
    again_ = Clock::now() + (loaded->renderer ? std::chrono::seconds(0) : patience);
  }
  return {false, loaded->problem, std::move(version)};
}

}  // namespace ergodome
