#pragma once

#include <chrono>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "app/exhibit/exhibit.h"
#include "app/player/renderers/renderer_loader.h"

namespace ergodome {

//! The renderers of a player's scenes. One is in use; those of other scenes are kept ready, so that
//! visitors need not wait. Lost renderers are rebuilt in another thread.
class SceneRenderers {
 public:
  explicit SceneRenderers(RendererLoader::Make make) : make_(make), loader_(std::move(make)) {}

  //! Makes the renderer of a scene immediately. Throws what `make` throws.
  void prepare(ExhibitScene scene, const Show& show) { of_scenes_[scene] = make_(show); }

  //! Shows this scene, with its renderer if there is one; otherwise starts to make one.
  void enter(ExhibitScene scene, const Show& show);

  //! Makes a renderer for another version of the scene's show. The old one stays in use until it is
  //! ready.
  void renew(const Show& show) { loader_.load({show, true}); }
  //! Returns whether a version that renew() requested is being loaded.
  [[nodiscard]] bool renews() const { return loader_.loads_version(); }

  //! Discards the current renderer, which failed or hung, and starts to make another one, unless
  //! another version is being loaded.
  void lose(const Show& show);

  //! Result of advance(), which takes the renderer that was loaded for `show`, or for another
  //! version of it: whether another renderer is in use, or why there is none. advance() is called
  //! once per frame and discards renderers that other scenes have for an older version.
  struct News {
    bool another = false;
    std::string problem;
    //! The version that became current, or, with a problem, cannot be used.
    std::optional<Show> version{};
  };
  News advance(const Show& show);

  //! Returns the current renderer; null while a lost one is rebuilt.
  [[nodiscard]] const std::shared_ptr<ShowRenderer>& current() const { return current_; }
  //! Returns a description of the backend of the current renderer, or of the last one.
  [[nodiscard]] const std::string& backend() const { return backend_; }

 private:
  using Clock = std::chrono::steady_clock;

  void use(std::shared_ptr<ShowRenderer> renderer);

  RendererLoader::Make make_;
  RendererLoader loader_;
  ExhibitScene scene_ = ExhibitScene::attract;
  std::map<ExhibitScene, std::shared_ptr<ShowRenderer>> of_scenes_;
  std::shared_ptr<ShowRenderer> current_;
  std::string backend_;
  std::optional<Clock::time_point> again_;  //!< when to retry after a failure
};

}  // namespace ergodome
