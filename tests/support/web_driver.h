#pragma once

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "tests/support/child_process.h"

namespace ergodome::test {

//! A headless Chromium, driven through chromedriver by the WebDriver protocol (W3C). Every call fails with std::runtime_error where the
//! browser says that it cannot.
class WebDriver {
 public:
  //! Starts chromedriver and a browser; `why_not` tells why there is none.
  static std::unique_ptr<WebDriver> start(std::string& why_not);
  ~WebDriver();
  WebDriver(const WebDriver&) = delete;
  WebDriver& operator=(const WebDriver&) = delete;

  void open(const std::string& url);
  //! What a script returns; `arguments` is an array.
  nlohmann::json run(const std::string& script, const nlohmann::json& arguments = nlohmann::json::array());
  //! The visible text of what a CSS selector finds first.
  std::string text(const std::string& selector);
  void click(const std::string& selector);
  //! Types into what has the focus.
  void press(const std::string& key);
  //! Presses the pointer on a range at a part of its width, moves it to another and, unless it is to be held, lets it go.
  void drag(const std::string& selector, double from, double to, bool release = true);
  void release();
  //! The size of what the page has to itself, as on a tablet.
  void set_size(int width_px, int height_px);
  void screenshot(const std::filesystem::path& png);

 private:
  explicit WebDriver(std::unique_ptr<ChildProcess> process, int port);
  bool begin_session(std::string& why_not);
  nlohmann::json ask(const std::string& method, const std::string& path, const nlohmann::json& body = nullptr);
  nlohmann::json element(const std::string& selector);

  std::unique_ptr<ChildProcess> process_;
  int port_ = 0;
  std::string session_;
};

}  // namespace ergodome::test
