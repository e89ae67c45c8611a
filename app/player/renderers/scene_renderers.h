#pragma once

#include <chrono>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "app/exhibit/exhibit.h"
#include "app/player/renderers/renderer_loader.h"

namespace ergodome {

//! The renderers of a player's scenes. One is in use; those of other scenes wait, so that no visitor does; those that are lost are made anew
//! beside the player's thread.
class SceneRenderers {
 public:
  explicit SceneRenderers(RendererLoader::Make make) : make_(make), loader_(std::move(make)) {}

  //! Makes a scene's renderer now. Throws what making it throws.
  void prepare(ExhibitScene scene, const Show& show) { of_scenes_[scene] = make_(show); }

  //! From now on this scene is shown, with the renderer that it has, or with one that begins to be made.
  void enter(ExhibitScene scene, const Show& show);

  //! Makes a renderer for another version of the scene's show; the old one is in use until it is there.
  void renew(const Show& show) { loader_.load({show, true}); }
  //! Whether such a version is on its way.
  [[nodiscard]] bool renews() const { return loader_.loads_version(); }

  //! Gives up the renderer in use, which fails or hangs, and begins to make another one, if none is on its way.
  void lose(const Show& show);

  //! Once a frame: takes what was made for `show`, or for another version of it. Whether there is another renderer in use now; or why there is none,
  //! a sentence each time. Renderers that other scenes have of a show that has another version are given up.
  struct News {
    bool another = false;
    std::string problem;
    std::optional<Show> version{};  //!< the one that is in use from now on, or, with a problem, cannot be
  };
  News advance(const Show& show);

  //! Null while a lost one is made anew.
  [[nodiscard]] const std::shared_ptr<ShowRenderer>& current() const { return current_; }
  //! Where the one in use, or the last one, makes pictures; for people.
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
  std::optional<Clock::time_point> again_;  //!< when to try once more what failed
};

}  // namespace ergodome
