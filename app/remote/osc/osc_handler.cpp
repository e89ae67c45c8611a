#include "app/remote/osc/osc_handler.h"

#include <fmt/format.h>
#include <lo/lo.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <limits>

#include "app/remote/common/command_rules.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

using std::chrono::steady_clock;

constexpr std::string_view root = "/ergodome/";
constexpr std::size_t longest_quote = 60;
//! OSC addresses other than commands.
constexpr std::array<std::string_view, 5> own_words = {"clock", "subscribe", "nonce", "unsubscribe", "ping"};

//! Returns an untrusted name for display: shortened, with unprintable characters replaced.
std::string quotable(const std::string& text) {
  std::string result = text.substr(0, longest_quote);
  std::replace_if(
      result.begin(), result.end(), [](unsigned char c) { return std::isprint(c) == 0; }, '?');
  return result;
}

steady_clock::time_point after(steady_clock::time_point from, double seconds) {
  return from + std::chrono::duration_cast<steady_clock::duration>(std::chrono::duration<double>(seconds));
}

//! Returns how long a message has to wait until its time tag [s]; 0 if that is past. Throws Error
//! if it is more than `longest_wait_s` ahead.
double wait_s(const OscMessage& message, const OscInstant& now) {
  const double wait = message.time == osc_at_once ? 0.0 : osc_difference_s(message.time, now.of_day);
  if (wait > OscHandler::longest_wait_s) {
    throw Error("bundle", fmt::format("its time tag is {:.0f} s in the future", wait),
                fmt::format("send it at most {:.0f} s ahead, and synchronize the clocks of both machines",
                            OscHandler::longest_wait_s));
  }
  return std::max(wait, 0.0);
}

//! Returns the word that an unknown address may have meant; empty if none is close. An address with
//! another prefix must end in a known word.
std::string meant_word(const std::string& address) {
  if (address.starts_with(root)) {
    return nearest_command(address.substr(root.size()), own_words);
  }
  const std::string last = address.substr(address.rfind('/') + 1);
  const bool ours = rule_of(last) != nullptr || std::find(own_words.begin(), own_words.end(), last) != own_words.end();
  return ours ? last : "";
}

//! Returns the rule of the command that an address names. Throws Error, with a suggestion, if it
//! names none.
const CommandRule& rule_at(const std::string& address) {
  const CommandRule* const rule = address.starts_with(root) ? rule_of(address.substr(root.size())) : nullptr;
  if (rule == nullptr) {
    const std::string meant = meant_word(address);
    throw Error(
        quotable(address), "unknown address",
        meant.empty() ? "see reference/osc.md in the documentation" : fmt::format("did you mean {}{}?", root, meant));
  }
  return *rule;
}

CommandArgument argument_at(const OscMessage& message, std::size_t index) {
  return index < message.arguments.size() ? message.arguments[index] : CommandArgument{};
}

//! Converts an argument to a number if it is a text that contains one, as some show controllers
//! send; otherwise returns it unchanged.
CommandArgument numeric(CommandArgument argument) {
  if (const std::string* const text = std::get_if<std::string>(&argument)) {
    double number = 0.0;
    const char* const last = text->data() + text->size();
    const auto [end, error] = std::from_chars(text->data(), last, number);
    if (error == std::errc() && end == last && !text->empty()) {
      return number;
    }
  }
  return argument;
}

bool takes_number(Argument argument) {
  return argument == Argument::number || argument == Argument::whole || argument == Argument::flag ||
         argument == Argument::none;
}

bool is_pattern(const std::string& address) { return address.find_first_of("*?[{") != std::string::npos; }

//! Returns the rules of the commands that match an address or OSC address pattern. Throws Error if
//! none matches.
std::vector<const CommandRule*> rules_at(const std::string& address) {
  if (!is_pattern(address)) {
    return {&rule_at(address)};
  }
  std::vector<const CommandRule*> matching;
  for (const CommandRule& rule : command_rules()) {
    if (lo_pattern_match(fmt::format("{}{}", root, rule.name).c_str(), address.c_str()) != 0) {
      matching.push_back(&rule);
    }
  }
  if (matching.empty()) {
    throw Error(quotable(address), "matches no address", "see reference/osc.md in the documentation");
  }
  return matching;
}

void expect_at_most(const OscMessage& message, std::size_t count) {
  if (message.arguments.size() > count) {
    throw Error(message.address.substr(root.size()), fmt::format("has {} arguments", message.arguments.size()),
                fmt::format("send at most {}", count));
  }
}

//! Returns whether a value means release. Buttons of control surfaces send 1 when pressed and 0
//! when released; commands without an argument ignore the release.
bool is_release(const CommandArgument& argument) {
  const double* const number = std::get_if<double>(&argument);
  const bool* const flag = std::get_if<bool>(&argument);
  return (number != nullptr && *number == 0.0) || (flag != nullptr && !*flag);
}

double number_at(const OscMessage& message, std::size_t index, std::string_view name, double minimum, double maximum) {
  const CommandArgument argument = numeric(argument_at(message, index));
  const double* const number = std::get_if<double>(&argument);
  if (number == nullptr) {
    throw Error(std::string(name), "needs a number", "add one to the message");
  }
  return checked_number(name, *number, minimum, maximum);
}

}  // namespace

std::vector<OscDatagram> OscHandler::receive(std::span<const std::byte> packet, const NetAddress& from,
                                             const OscInstant& now) {
  std::vector<OscDatagram> answers;
  // The sender of a packet may be forged. So the answers to an address that is not trusted are
  // together at most as long as the packet.
  std::size_t bytes_left = subscribers_.is_trusted(from) ? std::numeric_limits<std::size_t>::max() : packet.size();
  const auto answer = [&](const NetAddress& to, const OscOutput& message) {
    std::vector<char> bytes = osc_packet({&message, 1});
    if (bytes.size() <= bytes_left) {
      bytes_left -= bytes.size();
      answers.push_back({to, std::move(bytes)});
    }
  };
  const auto complain = [&](const std::string& address, const Error& error) {
    if (complaints_.allows(now.steady)) {
      warn(from, error.what(), now.steady);
      answer(from, {"/ergodome/error", {quotable(address), std::string(error.what())}});
    }
  };
  std::vector<OscMessage> messages;
  try {
    messages = parse_osc(packet);
  } catch (const Error& error) {
    complain("", error);
  }
  for (const OscMessage& message : messages) {
    try {
      if (const std::optional<Answer> reply = heed(message, from, now)) {
        answer(reply->to, reply->message);
      }
    } catch (const Error& error) {
      complain(message.address, error);
    }
  }
  return answers;
}

std::optional<OscHandler::Answer> OscHandler::heed(const OscMessage& message, const NetAddress& from,
                                                   const OscInstant& now) {
  if (message.address == "/ergodome/clock") {
    follow_clock(message, now);
  } else if (message.address == "/ergodome/subscribe") {
    return subscribe(message, from, now);
  } else if (message.address == "/ergodome/nonce") {
    confirm(message, from, now);
  } else if (message.address == "/ergodome/unsubscribe") {
    unsubscribe(message, from);
  } else if (message.address == "/ergodome/ping") {
    return Answer{from, {"/ergodome/pong", {}}};
  } else {
    command(message, from, now);
  }
  return std::nullopt;
}

void OscHandler::warn(const NetAddress& from, const std::string& problem, steady_clock::time_point now) {
  if (listeners_.warning && warnings_.allows(now)) {
    listeners_.warning(fmt::format("OSC from {}: {}", from.host(), problem));
  }
}

void OscHandler::command(const OscMessage& message, const NetAddress& from, const OscInstant& now) {
  for (const CommandRule* const rule : rules_at(message.address)) {
    command(*rule, message, from, now);
  }
}

void OscHandler::command(const CommandRule& rule, const OscMessage& message, const NetAddress& from,
                         const OscInstant& now) {
  // Ignores further arguments, as OSC receivers do: control surfaces add coordinates or names.
  CommandArgument argument = argument_at(message, 0);
  argument = takes_number(rule.argument) ? numeric(std::move(argument)) : std::move(argument);
  if (rule.argument == Argument::none && is_release(argument)) {
    return;
  }
  TransportCommand command = checked_command(rule, argument, board_.read());
  command.source = "OSC " + from.host();
  const double wait = wait_s(message, now);
  if (wait == 0.0) {
    commands_.push(std::move(command));
    return;
  }
  if (waiting_.size() >= max_waiting) {
    throw Error("bundle", fmt::format("{} commands are already scheduled, which is the maximum", max_waiting),
                "send the bundle later");
  }
  const steady_clock::time_point due = after(now.steady, wait);
  const auto position = std::upper_bound(waiting_.begin(), waiting_.end(), due,
                                         [](auto time, const Waiting& each) { return time < each.due; });
  waiting_.insert(position, {due, std::move(command)});
}

void OscHandler::follow_clock(const OscMessage& message, const OscInstant& now) {
  if (!listeners_.clock) {
    throw Error("clock", "the show does not follow an OSC clock", "start the player with --clock osc");
  }
  ClockFix fix;
  fix.show_time = show_time(number_at(message, 0, "clock", -max_show_time_s, max_show_time_s));
  if (message.arguments.size() >= 2) {
    fix.speed = number_at(message, 1, "clock", -max_speed, max_speed);
  }
  // The time tag of a bundle is when its clock value is valid, in the past or the future.
  const double ahead_s = message.time == osc_at_once ? 0.0 : osc_difference_s(message.time, now.of_day);
  if (!(std::abs(ahead_s) <= longest_wait_s)) {
    throw Error("clock",
                fmt::format("the time tag of the bundle is {:.0f} s in the {}", std::abs(ahead_s),
                            ahead_s > 0.0 ? "future" : "past"),
                "synchronize the clocks of both machines, or send the message without a time tag");
  }
  const steady_clock::time_point right_at = after(now.steady, ahead_s);
  fix.right_at = right_at.time_since_epoch();
  fix.heard = now.steady.time_since_epoch();
  listeners_.clock(fix);
}

namespace {

//! Returns the address for a subscriber's feedback: [host,] port, or the sender of the message.
//! Throws Error for another host, unless the sender is on this machine.
NetAddress subscriber_address(const OscMessage& message, const NetAddress& from) {
  expect_at_most(message, 2);
  if (message.arguments.empty()) {
    return from;
  }
  const std::string* const host = std::get_if<std::string>(message.arguments.data());
  const std::size_t port_at = host == nullptr ? 0 : 1;
  const int port = static_cast<int>(number_at(message, port_at, "subscribe: port", 1, 65'535));
  if (host == nullptr) {
    expect_at_most(message, 1);
    return from.with_port(port);
  }
  const std::optional<NetAddress> wanted = NetAddress::parse(*host, port);
  if (!wanted || wanted->family() != from.family()) {
    throw Error("subscribe", "the host is not a numeric address", "send one such as \"192.168.1.20\"");
  }
  if (wanted->host() != from.host() && !from.is_loopback()) {
    throw Error("subscribe", "only this machine may subscribe other hosts",
                "send the message from the host that needs the feedback");
  }
  return *wanted;
}

}  // namespace

std::optional<OscHandler::Answer> OscHandler::subscribe(const OscMessage& message, const NetAddress& from,
                                                        const OscInstant& now) {
  const NetAddress to = subscriber_address(message, from);
  if (!subscribers_.is_trusted(from)) {
    return Answer{to, {"/ergodome/nonce", {OscInteger{subscribers_.nonce(to, now.steady)}}}};
  }
  next_feedback_ = subscribers_.empty() ? now.steady : next_feedback_;
  subscribers_.add(to, now.steady);
  return std::nullopt;
}

void OscHandler::confirm(const OscMessage& message, const NetAddress& from, const OscInstant& now) {
  expect_at_most(message, 2);
  const double nonce = number_at(message, 0, "nonce", 1, 0xFFFFFF);
  const NetAddress to = message.arguments.size() < 2
                            ? from
                            : from.with_port(static_cast<int>(number_at(message, 1, "nonce: port", 1, 65'535)));
  if (!subscribers_.is_nonce(nonce, to, now.steady)) {
    throw Error("nonce", "is not the number that was sent to " + to.text(),
                "send /ergodome/subscribe again, and return the new number within a minute");
  }
  next_feedback_ = subscribers_.empty() ? now.steady : next_feedback_;
  subscribers_.add(to, now.steady);
}

void OscHandler::unsubscribe(const OscMessage& message, const NetAddress& from) {
  subscribers_.remove(subscriber_address(message, from));
}

std::vector<OscDatagram> OscHandler::tick(steady_clock::time_point now) {
  while (!waiting_.empty() && waiting_.front().due <= now) {
    commands_.push(std::move(waiting_.front().command));
    waiting_.erase(waiting_.begin());
  }
  subscribers_.remove_expired(now);
  std::vector<OscDatagram> feedback;
  if (!subscribers_.empty() && next_feedback_ <= now) {
    const std::vector<char> packet = osc_packet(osc_status(board_.read()));
    for (const NetAddress& to : subscribers_.addresses()) {
      feedback.push_back({to, packet});
    }
    // After a long stall, feedback continues from now instead of catching up.
    next_feedback_ = std::max(next_feedback_ + feedback_interval, now);
  }
  return feedback;
}

std::optional<steady_clock::time_point> OscHandler::next_tick() const {
  std::optional<steady_clock::time_point> next;
  if (!subscribers_.empty()) {
    next = next_feedback_;
  }
  if (!waiting_.empty()) {
    next = next ? std::min(*next, waiting_.front().due) : waiting_.front().due;
  }
  return next;
}

}  // namespace ergodome
