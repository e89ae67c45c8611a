#include "tests/support/web_driver.h"

#include <httplib.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <stdexcept>

namespace ergodome::test {

namespace {

using nlohmann::json;

//! Name of the JSON key with which WebDriver refers to elements of a page.
const char* const element_key = "element-6066-11e4-a52e-4f735466cecf";

json capabilities() {
  json arguments = {"--headless=new",         "--disable-gpu",     "--disable-dev-shm-usage",
                    "--window-size=1280,900", "--hide-scrollbars", "--no-first-run"};
  if (::geteuid() == 0) {
    // In containers, the user is root, for whom Chromium's sandbox does not work.
    arguments.push_back("--no-sandbox");
  }
  return {
      {"capabilities", {{"alwaysMatch", {{"browserName", "chrome"}, {"goog:chromeOptions", {{"args", arguments}}}}}}}};
}

//! Decodes base64, in which WebDriver sends pictures.
std::string from_base64(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned bits = 0;
  int count = 0;
  for (const char c : text) {
    const std::size_t digit = digits.find(c);
    if (digit == std::string::npos) {
      break;
    }
    bits = (bits << 6U) | static_cast<unsigned>(digit);
    count += 6;
    if (count >= 8) {
      count -= 8;
      bytes += static_cast<char>((bits >> static_cast<unsigned>(count)) & 0xFFU);
    }
  }
  return bytes;
}

}  // namespace

WebDriver::WebDriver(std::unique_ptr<ChildProcess> process, int port) : process_(std::move(process)), port_(port) {}

std::unique_ptr<WebDriver> WebDriver::start(std::string& why_not) {
  auto process = std::make_unique<ChildProcess>(std::vector<std::string>{"chromedriver", "--port=0"});
  const std::string said = "started successfully on port ";
  const std::string output =
      process->output_until(said, std::chrono::seconds(60)) + process->output_until("\n", std::chrono::seconds(5));
  const std::size_t at = output.find(said);
  if (at == std::string::npos) {
    why_not = "chromedriver does not start: " + output;
    return nullptr;
  }
  std::unique_ptr<WebDriver> driver(new WebDriver(std::move(process), std::atoi(output.c_str() + at + said.size())));
  return driver->begin_session(why_not) ? std::move(driver) : nullptr;
}

bool WebDriver::begin_session(std::string& why_not) {
  try {
    session_ = ask("POST", "/session", capabilities()).at("sessionId");
    return true;
  } catch (const std::exception& problem) {
    why_not = problem.what();
    return false;
  }
}

WebDriver::~WebDriver() {
  try {
    if (!session_.empty()) {
      ask("DELETE", "/session/" + session_);
    }
  } catch (const std::exception&) {
    // Ignores errors, because the process group is killed next.
  }
}

json WebDriver::ask(const std::string& method, const std::string& path, const json& body) {
  httplib::Client client("127.0.0.1", port_);
  client.set_read_timeout(60);
  const httplib::Result result = method == "POST"  ? client.Post(path, body.dump(), "application/json")
                                 : method == "GET" ? client.Get(path)
                                                   : client.Delete(path);
  if (!result) {
    throw std::runtime_error("chromedriver does not answer " + path);
  }
  json value = json::parse(result->body).at("value");
  if (result->status != 200) {
    throw std::runtime_error(path + ": " + value.dump());
  }
  return value;
}

void WebDriver::open(const std::string& url) { ask("POST", "/session/" + session_ + "/url", {{"url", url}}); }

json WebDriver::run(const std::string& script, const json& arguments) {
  return ask("POST", "/session/" + session_ + "/execute/sync", {{"script", script}, {"args", arguments}});
}

json WebDriver::element(const std::string& selector) {
  return ask("POST", "/session/" + session_ + "/element", {{"using", "css selector"}, {"value", selector}});
}

std::string WebDriver::text(const std::string& selector) {
  const std::string id = element(selector).at(element_key);
  return ask("GET", "/session/" + session_ + "/element/" + id + "/text");
}

void WebDriver::click(const std::string& selector) {
  const std::string id = element(selector).at(element_key);
  ask("POST", "/session/" + session_ + "/element/" + id + "/click", json::object());
}

void WebDriver::press(const std::string& key) {
  const json actions = {{{"type", "keyDown"}, {"value", key}}, {{"type", "keyUp"}, {"value", key}}};
  ask("POST", "/session/" + session_ + "/actions",
      {{"actions", {{{"type", "key"}, {"id", "keys"}, {"actions", actions}}}}});
}

void WebDriver::drag(const std::string& selector, double from, double to, bool release) {
  run("document.querySelector(arguments[0]).scrollIntoView({block: 'center'})", {selector});
  const json box =
      run("const b = document.querySelector(arguments[0]).getBoundingClientRect();"
          "return [b.left, b.top, b.width, b.height]",
          {selector});
  const auto x = [&](double part) { return std::lround(box[0].get<double>() + part * box[2].get<double>()); };
  const long y = std::lround(box[1].get<double>() + box[3].get<double>() / 2.0);
  const auto move = [&](double part) {
    return json{{"type", "pointerMove"}, {"duration", 100}, {"x", x(part)}, {"y", y}};
  };
  json actions = {move(from), {{"type", "pointerDown"}, {"button", 0}}, move((from + to) / 2.0), move(to)};
  if (release) {
    actions.push_back({{"type", "pointerUp"}, {"button", 0}});
  }
  ask("POST", "/session/" + session_ + "/actions",
      {{"actions",
        {{{"type", "pointer"}, {"id", "finger"}, {"parameters", {{"pointerType", "mouse"}}}, {"actions", actions}}}}});
}

void WebDriver::release() { ask("DELETE", "/session/" + session_ + "/actions"); }

void WebDriver::set_size(int width_px, int height_px) {
  ask("POST", "/session/" + session_ + "/goog/cdp/execute",
      {{"cmd", "Emulation.setDeviceMetricsOverride"},
       {"params", {{"width", width_px}, {"height", height_px}, {"deviceScaleFactor", 1}, {"mobile", false}}}});
}

void WebDriver::screenshot(const std::filesystem::path& png) {
  const std::string bytes = from_base64(ask("GET", "/session/" + session_ + "/screenshot"));
  std::ofstream(png, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace ergodome::test
