#include "app/remote/web/web_lobby.h"

#include <poll.h>

#include <algorithm>
#include <map>
#include <utility>

namespace ergodome {

void WebLobby::enter(std::unique_ptr<HttpStream> stream, Instant now) {
  if (waiting_.size() >= max_waiting) {
    make_room();
  }
  const Instant until = now + (stream->peer().is_loopback() ? loopback_time : outside_time);
  std::string host = stream->peer().host();
  waiting_.push_back({std::move(stream), std::move(host), until});
}

void WebLobby::make_room() {
  std::map<std::string_view, int> counts;
  for (const Waiting& each : waiting_) {
    ++counts[each.host];
  }
  const auto maximum = std::ranges::max_element(counts, {}, [](const auto& count) { return count.second; });
  waiting_.erase(std::ranges::find(waiting_, maximum->first, &Waiting::host));
}

WebLobby::Step WebLobby::step(Waiting& waiting, Instant now) const {
  if (waiting.refused) {
    if (now < waiting.until) {
      return Step::wait;
    }
    waiting.stream->refuse(no_token_answer(waiting.stream->head()));
    return Step::close;
  }
  switch (waiting.stream->poll_head()) {
    case HttpStream::Head::failed:
      return Step::close;
    case HttpStream::Head::incomplete:
      return now < waiting.until ? Step::wait : Step::close;
    case HttpStream::Head::complete:
      break;
  }
  if (waiting.stream->peer().is_loopback() || guard_.has_token(waiting.stream->head())) {
    return Step::admit;
  }
  waiting.refused = true;
  waiting.until = now + refusal_delay;
  return Step::wait;
}

std::vector<std::unique_ptr<HttpStream>> WebLobby::admit(Instant now) {
  std::vector<std::unique_ptr<HttpStream>> admitted;
  std::erase_if(waiting_, [&](Waiting& each) {
    const Step step = this->step(each, now);
    if (step == Step::admit) {
      admitted.push_back(std::move(each.stream));
    }
    return step != Step::wait;
  });
  return admitted;
}

void WebLobby::add_sockets(std::vector<pollfd>& sockets) const {
  for (const Waiting& each : waiting_) {
    if (!each.refused) {
      sockets.push_back({each.stream->socket(), POLLIN, 0});
    }
  }
}

WebLobby::Instant WebLobby::next_deadline(Instant otherwise) const {
  for (const Waiting& each : waiting_) {
    otherwise = std::min(otherwise, each.until);
  }
  return otherwise;
}

}  // namespace ergodome
