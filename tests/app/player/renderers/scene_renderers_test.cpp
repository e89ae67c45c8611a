#include "app/player/renderers/scene_renderers.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>

#include "content/files/atomic_file.h"
#include "content/show/reading/show_reader.h"
#include "tests/support/folder_test.h"

namespace ergodome {
namespace {

class SceneRenderersTest : public test::FolderTest {
 protected:
  //! Returns a show with a tiny map of one color, so that its renderer is created in a short time.
  Show show(const std::string& name) const {
    std::string sky = "P3 8 4 255";
    for (int i = 0; i < 3 * 8 * 4; ++i) {
      sky += " 90";
    }
    write_text_atomically(folder_ / "sky.ppm", sky);
    Show show = parse_show("[sky]\nmap = \"sky.ppm\"\n[[camera.key]]\nr = 12\n", (folder_ / (name + ".toml")).string());
    show.name = name;
    return show;
  }

  //! Calls advance() once per frame until a new renderer is in use; returns whether that happened.
  static bool another(SceneRenderers& renderers, const Show& show) {
    for (int i = 0; i < 2000; ++i) {
      if (renderers.advance(show).another) {
        return true;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return false;
  }

  std::atomic<int> made_ = 0;
  RendererLoader::Make make_ = [this](const Show& any) {
    ++made_;
    return std::make_shared<ShowRenderer>(any, Backend::cpu);
  };
};

TEST_F(SceneRenderersTest, APreparedSceneIsThereAtOnce) {
  SceneRenderers renderers(make_);
  renderers.prepare(ExhibitScene::visitor, show("flight"));
  renderers.enter(ExhibitScene::visitor, show("flight"));
  ASSERT_NE(renderers.current(), nullptr);
  EXPECT_EQ(renderers.current()->show().name, "flight");
  EXPECT_FALSE(renderers.backend().empty());
}

TEST_F(SceneRenderersTest, ASceneThatIsComeBackToIsNotMadeAgain) {
  SceneRenderers renderers(make_);
  renderers.prepare(ExhibitScene::attract, show("a"));
  renderers.prepare(ExhibitScene::visitor, show("b"));
  for (int i = 0; i < 3; ++i) {
    renderers.enter(ExhibitScene::visitor, show("b"));
    renderers.enter(ExhibitScene::attract, show("a"));
  }
  EXPECT_EQ(renderers.current()->show().name, "a");
  EXPECT_EQ(made_, 2);
}

TEST_F(SceneRenderersTest, ALostOneIsMadeAnewForItsSceneAlone) {
  SceneRenderers renderers(make_);
  renderers.prepare(ExhibitScene::attract, show("a"));
  renderers.enter(ExhibitScene::attract, show("a"));
  const auto first = renderers.current();
  renderers.lose(show("a"));
  EXPECT_EQ(renderers.current(), nullptr);
  ASSERT_TRUE(another(renderers, show("a")));
  EXPECT_NE(renderers.current(), first);
  EXPECT_NE(renderers.current(), nullptr);
}

TEST_F(SceneRenderersTest, TheOldVersionIsInUseUntilTheNewOneIsThere) {
  SceneRenderers renderers(make_);
  renderers.prepare(ExhibitScene::attract, show("a"));
  renderers.enter(ExhibitScene::attract, show("a"));
  const auto first = renderers.current();
  renderers.renew(show("a"));
  EXPECT_EQ(renderers.current(), first);
  ASSERT_TRUE(another(renderers, show("a")));
  EXPECT_NE(renderers.current(), first);
}

TEST_F(SceneRenderersTest, AVersionComesWithItsRendererAndEndsThoseOfOtherScenes) {
  SceneRenderers renderers(make_);
  renderers.prepare(ExhibitScene::visitor, show("a"));
  renderers.prepare(ExhibitScene::attract, show("a"));
  renderers.enter(ExhibitScene::attract, show("a"));
  Show next = show("a");
  next.title = {{"", "Next"}};
  renderers.renew(next);
  EXPECT_TRUE(renderers.renews());
  std::optional<Show> version;
  for (int i = 0; i < 2000 && !version; ++i) {
    version = renderers.advance(show("a")).version;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  ASSERT_TRUE(version);
  EXPECT_EQ(text_in(version->title, ""), "Next");
  EXPECT_EQ(text_in(renderers.current()->show().title, ""), "Next");
  EXPECT_FALSE(renderers.renews());
  renderers.enter(ExhibitScene::visitor, next);
  EXPECT_EQ(renderers.current(), nullptr) << "the old version's";
}

TEST_F(SceneRenderersTest, AVersionThatCannotBeMadeIsToldAndTheOldOneIsInUse) {
  std::atomic<bool> broken = false;
  SceneRenderers renderers([&](const Show& any) {
    if (broken) {
      throw std::runtime_error("no sky");
    }
    return make_(any);
  });
  renderers.prepare(ExhibitScene::attract, show("a"));
  renderers.enter(ExhibitScene::attract, show("a"));
  const auto first = renderers.current();
  broken = true;
  renderers.renew(show("a"));
  SceneRenderers::News news;
  for (int i = 0; i < 2000 && news.problem.empty(); ++i) {
    news = renderers.advance(show("a"));
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_EQ(news.problem, "no sky");
  EXPECT_FALSE(news.another);
  EXPECT_TRUE(news.version);
  EXPECT_EQ(renderers.current(), first);
}

TEST_F(SceneRenderersTest, WhatFailsIsToldAndTriedAgain) {
  std::atomic<int> tries = 0;
  SceneRenderers renderers([&](const Show& any) {
    if (++tries < 3) {
      throw std::runtime_error("the GPU is lost");
    }
    return std::make_shared<ShowRenderer>(any, Backend::cpu);
  });
  renderers.enter(ExhibitScene::attract, show("a"));
  std::string reported;
  for (int i = 0; i < 2000 && !renderers.current(); ++i) {
    const SceneRenderers::News news = renderers.advance(show("a"));
    reported += news.problem;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_NE(renderers.current(), nullptr);
  EXPECT_EQ(reported, "the GPU is lostthe GPU is lost");
  EXPECT_EQ(tries, 3);
}

}  // namespace
}  // namespace ergodome
