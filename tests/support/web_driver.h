#pragma once

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "tests/support/child_process.h"

namespace ergodome::test {

//! A headless Chromium, driven through chromedriver by the WebDriver protocol (W3C). Every call
//! throws std::runtime_error if the browser reports an error.
class WebDriver {
 public:
  //! Starts chromedriver and a browser. Returns null if that fails, with the reason in `why_not`.
  static std::unique_ptr<WebDriver> start(std::string& why_not);
  ~WebDriver();
  WebDriver(const WebDriver&) = delete;
  WebDriver& operator=(const WebDriver&) = delete;

  void open(const std::string& url);
  //! Runs a JavaScript function body in the page and returns its result; `arguments` is an array.
  nlohmann::json run(const std::string& script, const nlohmann::json& arguments = nlohmann::json::array());
  //! Returns the visible text of the first element that matches a CSS selector.
  std::string text(const std::string& selector);
  void click(const std::string& selector);
  //! Types into the element that has the focus.
  void press(const std::string& key);
  //! Presses the pointer on a range input at the fraction `from` of its width, and moves it to
  //! `to`. Releases it if `release`.
  void drag(const std::string& selector, double from, double to, bool release = true);
  void release();
  //! Sets the size of the viewport, for instance to that of a tablet.
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
