#include "app/remote/osc/osc_subscribers.h"

#include <fmt/format.h>
#include <glib.h>

#include <algorithm>
#include <memory>

#include "app/remote/web/web_token.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

//! Returns the number of the half minute that contains a time. Nonces of the current and the
//! previous half minute are valid.
std::int64_t period_of(OscSubscribers::Instant now) {
  return now.time_since_epoch() / (OscSubscribers::nonce_lifetime / 2);
}

}  // namespace

OscSubscribers::OscSubscribers(std::vector<NetAddress> listed) : listed_(std::move(listed)), secret_(new_web_token()) {}

bool OscSubscribers::is_trusted(const NetAddress& host) const {
  const auto is_here = [&](const NetAddress& each) { return each.host() == host.host(); };
  return host.is_loopback() || std::ranges::any_of(listed_, is_here) ||
         std::ranges::any_of(subscribers_, is_here, &Subscriber::to);
}

std::int32_t OscSubscribers::nonce_of(const NetAddress& to, std::int64_t period) const {
  const std::string text = fmt::format("{} {}", to.text(), period);
  const std::unique_ptr<char, decltype(&g_free)> digits(
      g_compute_hmac_for_string(G_CHECKSUM_SHA256, reinterpret_cast<const guchar*>(secret_.data()), secret_.size(),
                                text.data(), static_cast<gssize>(text.size())),
      &g_free);
  constexpr std::size_t hexadecimal_digits = 6;
  const auto number = std::stol(std::string(digits.get(), hexadecimal_digits), nullptr, 16);
  return std::max<std::int32_t>(1, static_cast<std::int32_t>(number));
}

std::int32_t OscSubscribers::nonce(const NetAddress& to, Instant now) const { return nonce_of(to, period_of(now)); }

bool OscSubscribers::is_nonce(double number, const NetAddress& to, Instant now) const {
  const std::int64_t period = period_of(now);
  return number == nonce_of(to, period) || number == nonce_of(to, period - 1);
}

void OscSubscribers::add(const NetAddress& to, Instant now) {
  if (std::ranges::find(listed_, to) != listed_.end()) {
    return;
  }
  const auto known = std::ranges::find(subscribers_, to, &Subscriber::to);
  if (known != subscribers_.end()) {
    known->until = now + subscription;
    return;
  }
  if (subscribers_.size() >= max_subscribers) {
    throw Error("subscribe", fmt::format("there are already {} subscribers, which is the maximum", max_subscribers),
                "remove one with /ergodome/unsubscribe, or wait until one expires");
  }
  subscribers_.push_back({to, now + subscription});
}

void OscSubscribers::remove(const NetAddress& to) {
  std::erase_if(subscribers_, [&](const Subscriber& each) { return each.to == to; });
}

void OscSubscribers::remove_expired(Instant now) {
  std::erase_if(subscribers_, [&](const Subscriber& each) { return each.until <= now; });
}

std::vector<NetAddress> OscSubscribers::addresses() const {
  std::vector<NetAddress> all = listed_;
  std::ranges::transform(subscribers_, std::back_inserter(all), &Subscriber::to);
  return all;
}

}  // namespace ergodome
