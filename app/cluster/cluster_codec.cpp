#include "app/cluster/cluster_codec.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <type_traits>
#include <utility>

namespace ergodome {

namespace {

constexpr double largest_cluster_number = 1e15;

//! Appends values to a message.
class ClusterWriter {
 public:
  ClusterWriter(std::uint8_t kind) {
    bytes_ = {std::byte{'E'}, std::byte{'D'}, std::byte{cluster_format}, std::byte{kind}};
  }

  void range(double& value, double /*minimum*/, double /*maximum*/) { whole(std::bit_cast<std::uint64_t>(value)); }
  template <class Whole>
  void integer(Whole& value, std::int64_t /*minimum*/, std::int64_t /*maximum*/) {
    whole(static_cast<std::make_unsigned_t<Whole>>(value));
  }
  void count(std::uint64_t& value) { whole(value); }
  void flag(bool& value) { whole(static_cast<std::uint8_t>(value)); }
  template <class Choice>
  void choice(Choice& value, int /*count*/) {
    whole(static_cast<std::uint8_t>(value));
  }
  void raw(const std::string& value, std::size_t longest) { text(value, longest); }
  //! A text that may have several lines.
  void lines(const std::string& value, std::size_t longest) { text(value, longest); }
  void text(const std::string& value, std::size_t longest) {
    const std::size_t size = std::min(value.size(), longest);
    whole(static_cast<std::uint16_t>(size));
    for (std::size_t i = 0; i < size; ++i) {
      bytes_.push_back(static_cast<std::byte>(value[i]));
    }
  }
  //! Returns whether an optional value follows.
  template <class Value>
  bool present(std::optional<Value>& value) {
    bool given = value.has_value();
    flag(given);
    return given;
  }
  //! The number of elements of a list, of which only `most` are sent.
  template <class Element>
  void size(std::vector<Element>& list, std::size_t most) {
    list.resize(std::min(list.size(), most));
    whole(static_cast<std::uint16_t>(list.size()));
  }
  void check(bool /*valid*/) {}

  [[nodiscard]] std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  template <class Unsigned>
  void whole(Unsigned value) {
    for (std::size_t i = 0; i < sizeof value; ++i) {
      bytes_.push_back(static_cast<std::byte>((static_cast<std::uint64_t>(value) >> (8U * i)) & 0xffU));
    }
  }

  std::vector<std::byte> bytes_;
};

//! Reads values from a message and remembers whether one was missing or invalid.
class ClusterReader {
 public:
  explicit ClusterReader(std::span<const std::byte> bytes) : rest_(bytes) {}

  void range(double& value, double minimum, double maximum) {
    value = std::bit_cast<double>(whole<std::uint64_t>());
    check(value >= minimum && value <= maximum);
  }
  template <class Whole>
  void integer(Whole& value, std::int64_t minimum, std::int64_t maximum) {
    value = static_cast<Whole>(whole<std::make_unsigned_t<Whole>>());
    check(static_cast<std::int64_t>(value) >= minimum && static_cast<std::int64_t>(value) <= maximum);
  }
  void count(std::uint64_t& value) { value = whole<std::uint64_t>(); }
  void flag(bool& value) {
    const auto byte = whole<std::uint8_t>();
    check(byte <= 1);
    value = byte == 1;
  }
  template <class Choice>
  void choice(Choice& value, int count) {
    const auto byte = whole<std::uint8_t>();
    check(byte < count);
    value = static_cast<Choice>(valid_ ? byte : 0);
  }
  void text(std::string& value, std::size_t longest) {
    bytes(value, longest);
    check(std::ranges::none_of(value, is_control));
  }
  void raw(std::string& value, std::size_t longest) { bytes(value, longest); }
  void lines(std::string& value, std::size_t longest) {
    bytes(value, longest);
    check(std::ranges::none_of(value, [](char c) { return is_control(c) && c != '\n' && c != '\t'; }));
  }
  template <class Element>
  void size(std::vector<Element>& list, std::size_t most) {
    const std::size_t size = whole<std::uint16_t>();
    check(size <= most);
    list.resize(valid_ ? size : 0);
  }
  template <class Value>
  bool present(std::optional<Value>& value) {
    bool given = false;
    flag(given);
    if (given && valid_) {
      value.emplace();
    }
    return value.has_value();
  }
  void check(bool valid) { valid_ = valid_ && valid; }

  //! Returns whether everything was valid and nothing is left.
  [[nodiscard]] bool complete() const { return valid_ && rest_.empty(); }

 private:
  static bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }

  void bytes(std::string& value, std::size_t longest) {
    const std::size_t size = whole<std::uint16_t>();
    check(size <= longest && size <= rest_.size());
    if (valid_) {
      value.assign(reinterpret_cast<const char*>(rest_.data()), size);
      rest_ = rest_.subspan(size);
    }
  }

  template <class Unsigned>
  Unsigned whole() {
    if (rest_.size() < sizeof(Unsigned)) {
      valid_ = false;
      return 0;
    }
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < sizeof(Unsigned); ++i) {
      value |= static_cast<std::uint64_t>(rest_[i]) << (8U * i);
    }
    rest_ = rest_.subspan(sizeof(Unsigned));
    return static_cast<Unsigned>(value);
  }

  std::span<const std::byte> rest_;
  bool valid_ = true;
};

// Each pass_cluster() lists the members of a message once, for the writer and the reader.

template <class Coder>
void pass_cluster_velocity(Coder& coder, Vector3<double>& velocity) {
  coder.range(velocity.x, -1.0, 1.0);
  coder.range(velocity.y, -1.0, 1.0);
  coder.range(velocity.z, -1.0, 1.0);
  coder.check(dot(velocity, velocity) < 1.0);
}

template <class Coder>
void pass_cluster(Coder& coder, CameraPose& pose) {
  coder.range(pose.r, 1e-6, largest_cluster_number);
  coder.range(pose.theta, -10.0, 10.0);
  coder.range(pose.phi, -largest_cluster_number, largest_cluster_number);
  glm::dquat& turn = pose.orientation;
  for (double* const part : {&turn.w, &turn.x, &turn.y, &turn.z}) {
    coder.range(*part, -1.001, 1.001);
  }
  constexpr double rounding = 1e-6;
  coder.check(std::abs(turn.w * turn.w + turn.x * turn.x + turn.y * turn.y + turn.z * turn.z - 1.0) < rounding);
  if (coder.present(pose.velocity)) {
    pass_cluster_velocity(coder, *pose.velocity);
  }
  coder.flag(pose.velocity_in_rain);
  coder.range(pose.clock_lead, -largest_cluster_number, largest_cluster_number);
}

template <class Coder>
void pass_cluster(Coder& coder, StereoSettings& stereo) {
  coder.choice(stereo.layout, static_cast<int>(stereo_layout_names.size()));
  coder.choice(stereo.model, static_cast<int>(stereo_model_names.size()));
  coder.range(stereo.baseline, 0.0, largest_cluster_number);
  coder.range(stereo.convergence, 0.0, largest_cluster_number);
  coder.range(stereo.fade_from_deg, 0.0, 90.0);
  coder.range(stereo.fade_to_deg, 0.0, 90.0);
  coder.range(stereo.comfort_deg, 0.0, 180.0);
  coder.flag(stereo.swap_eyes);
  coder.flag(stereo.tint_eyes);
}

template <class Coder>
void pass_cluster(Coder& coder, ClusterFrame& frame) {
  constexpr std::int64_t longest_ns = 4'000'000'000'000'000'000;
  constexpr double most_stops = 1000.0;
  constexpr int view_modes = static_cast<int>(ViewMode::magnification) + 1;
  constexpr int motions = static_cast<int>(ObserverMotion::rain_boost) + 1;
  constexpr int lenses = 4;
  coder.count(frame.number);
  coder.integer(frame.epoch, 0, 0xffffffffLL);
  coder.integer(frame.time_ns, -longest_ns, longest_ns);
  coder.flag(frame.on_path);
  coder.range(frame.rate, -1000.0, 1000.0);
  coder.flag(frame.attract);
  pass_cluster(coder, frame.pose);
  if (coder.present(frame.before)) {
    coder.range(frame.before->r, 1e-6, largest_cluster_number);
    coder.range(frame.before->theta, -10.0, 10.0);
  }
  coder.choice(frame.motion, motions);
  pass_cluster_velocity(coder, frame.velocity);
  coder.choice(frame.mode, view_modes);
  coder.range(frame.field_of_view_deg, 0.0, 360.0);
  pass_cluster(coder, frame.stereo);
  coder.range(frame.exposure_stops, -most_stops, most_stops);
  if (coder.present(frame.followed_stops)) {
    coder.range(*frame.followed_stops, -most_stops, most_stops);
  }
  coder.text(frame.language, max_cluster_name);
  coder.flag(frame.captions);
  coder.integer(frame.size_px, 1, 65536);
  coder.integer(frame.projectors_px, 0, 65536);
  if (coder.present(frame.quality)) {
    ClusterQuality& quality = *frame.quality;
    coder.range(quality.budget_px, 1e-6, 1e4);
    coder.integer(quality.lens, 0, lenses - 1);
    coder.choice(quality.filter, static_cast<int>(SkyFilter::polygon) + 1);
    coder.integer(quality.whole_px, 1, 65536);
  }
  coder.range(frame.texts_opacity, 0.0, 1.0);
  coder.integer(frame.texts, 0, 0xffffffffLL);
  coder.choice(frame.pattern, static_cast<int>(ClusterPattern::projector_numbers) + 1);
  coder.integer(frame.pattern_kind, 0, 255);
  coder.integer(frame.calibration, 0, 0xffffffffLL);
}

template <class Coder>
void pass_cluster(Coder& coder, ClusterHello& hello) {
  coder.text(hello.node, max_cluster_name);
  coder.check(!hello.node.empty());
  for (std::string* const text :
       {&hello.identity.version, &hello.identity.show, &hello.identity.content, &hello.identity.setup}) {
    coder.text(*text, max_cluster_name);
  }
}

template <class Coder>
void pass_cluster(Coder& coder, ClusterWelcome& welcome) {
  coder.count(welcome.session);
  coder.choice(welcome.sync, static_cast<int>(swap_sync_names.size()));
}

template <class Coder>
void pass_cluster(Coder& coder, ClusterRefused& refused) {
  coder.text(refused.reason, max_cluster_reason);
}

template <class Coder>
void pass_cluster(Coder& coder, ClusterReady& ready) {
  coder.count(ready.number);
  coder.range(ready.frame_ms, 0.0, 1e9);
}

template <class Coder>
void pass_cluster(Coder& coder, ClusterSwap& swap) {
  coder.count(swap.number);
}

template <class Coder>
void pass_cluster(Coder& coder, ClusterHeartbeat& heartbeat) {
  coder.count(heartbeat.session);
  coder.range(heartbeat.light, 0.0, 1.0);
  coder.flag(heartbeat.grouped);
}

template <class Coder>
void pass_cluster(Coder& coder, Caption& caption) {
  coder.range(caption.position.azimuth_deg, -1e6, 1e6);
  coder.range(caption.position.elevation_deg, -90.0, 90.0);
  coder.range(caption.position.roll_deg, -1e6, 1e6);
  coder.range(caption.letter_deg, 1e-3, 90.0);
  coder.range(caption.width_deg, 1e-3, 360.0);
  for (double& part : caption.color) {
    coder.range(part, 0.0, 1e6);
  }
  coder.lines(caption.text[""], max_cluster_caption);
}

template <class Coder>
void pass_cluster(Coder& coder, ClusterTexts& texts) {
  coder.integer(texts.version, 0, 0xffffffffLL);
  coder.size(texts.captions, max_cluster_captions);
  for (Caption& caption : texts.captions) {
    pass_cluster(coder, caption);
  }
}

template <class Coder>
void pass_cluster(Coder& coder, GridOffsets& offsets) {
  coder.integer(offsets.points, 2, GridOffsets::sizes.back());
  coder.check(std::ranges::find(GridOffsets::sizes, offsets.points) != GridOffsets::sizes.end());
  const auto count = static_cast<std::size_t>(offsets.points) * static_cast<std::size_t>(offsets.points);
  for (std::vector<double>* const numbers : {&offsets.right, &offsets.down}) {
    coder.size(*numbers, count);
    coder.check(numbers->size() == count);
    for (double& number : *numbers) {
      coder.range(number, -GridOffsets::farthest, GridOffsets::farthest);
    }
  }
}

template <class Coder>
void pass_cluster(Coder& coder, ClusterCalibration& calibration) {
  coder.integer(calibration.version, 0, 0xffffffffLL);
  coder.lines(calibration.setup, max_cluster_setup);
  coder.size(calibration.offsets, max_cluster_projectors);
  for (GridOffsets& offsets : calibration.offsets) {
    pass_cluster(coder, offsets);
  }
  coder.size(calibration.texts, max_cluster_projectors);
  for (std::string& text : calibration.texts) {
    coder.lines(text, max_cluster_reason);
  }
}

//! Passes the key of a file, which is a part of a file name.
template <class Coder>
void pass_cluster_key(Coder& coder, std::string& key) {
  coder.text(key, max_cluster_name);
  coder.check(!key.empty() && std::ranges::all_of(key, [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f') || c == '-';
  }));
}

template <class Coder>
void pass_cluster(Coder& coder, ClusterOffer& offer) {
  coder.size(offer.files, max_cluster_files);
  for (ClusterOffer::File& file : offer.files) {
    coder.text(file.name, max_cluster_file_name);
    pass_cluster_key(coder, file.key);
    coder.count(file.bytes);
  }
  coder.size(offer.shows, 2);
  coder.check(!offer.shows.empty());
  for (std::uint16_t& show : offer.shows) {
    coder.integer(show, 0, 0xffff);
    coder.check(show < offer.files.size());
  }
}

template <class Coder>
void pass_cluster(Coder& coder, ClusterWanted& wanted) {
  pass_cluster_key(coder, wanted.key);
  coder.count(wanted.offset);
}

template <class Coder>
void pass_cluster(Coder& coder, ClusterChunk& chunk) {
  pass_cluster_key(coder, chunk.key);
  coder.count(chunk.offset);
  coder.raw(chunk.bytes, max_cluster_chunk);
}

template <std::size_t kind = 0>
std::optional<ClusterMessage> read_cluster_kind(std::size_t wanted, ClusterReader& reader) {
  if constexpr (kind == std::variant_size_v<ClusterMessage>) {
    return std::nullopt;
  } else {
    if (kind != wanted) {
      return read_cluster_kind<kind + 1>(wanted, reader);
    }
    std::variant_alternative_t<kind, ClusterMessage> message{};
    pass_cluster(reader, message);
    return reader.complete() ? std::optional<ClusterMessage>(std::move(message)) : std::nullopt;
  }
}

}  // namespace

std::vector<std::byte> encode_cluster(const ClusterMessage& message) {
  ClusterWriter writer(static_cast<std::uint8_t>(message.index()));
  // The functions that both coders share take members that can be changed.
  ClusterMessage copy = message;
  std::visit([&writer](auto& each) { pass_cluster(writer, each); }, copy);
  return writer.take();
}

std::optional<ClusterMessage> decode_cluster(std::span<const std::byte> bytes) {
  constexpr std::size_t header = 4;
  if (bytes.size() < header || bytes.size() > max_cluster_message || bytes[0] != std::byte{'E'} ||
      bytes[1] != std::byte{'D'} || bytes[2] != std::byte{cluster_format}) {
    return std::nullopt;
  }
  ClusterReader reader(bytes.subspan(header));
  return read_cluster_kind(std::to_integer<std::size_t>(bytes[3]), reader);
}

}  // namespace ergodome
