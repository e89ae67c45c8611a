#include "app/commands/movie/mp4_boxes.h"

#include <fmt/format.h>

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace ergodome {

namespace {

constexpr std::uint64_t box_header_bytes = 8;
//! Bytes of a sample entry for video before its first child box.
constexpr std::uint64_t video_entry_bytes = 86;
//! Header, version, flags and number of entries of stsd, stco and co64.
constexpr std::uint64_t table_header_bytes = 16;
//! Maximum size of the index of a film; that of a day at 60 frames per second has about 100 MB.
constexpr std::uint64_t max_index_bytes = 1U << 30U;

//! Position of a box in the index.
struct Mp4Box {
  std::string type;
  std::uint64_t begin = 0;
  std::uint64_t end = 0;
};

//! The box `moov`, which contains the index of a film: its tracks, and the positions of their
//! samples.
class Mp4Index {
 public:
  Mp4Index(FilmFile& film, std::uint64_t begin, std::uint64_t size)
      : film_(film), begin_(begin), bytes_(film.read(begin, size)) {}

  [[nodiscard]] const std::string& bytes() const { return bytes_; }
  [[nodiscard]] Mp4Box whole() const { return {bytes_.substr(4, 4), 0, bytes_.size()}; }

  [[noreturn]] void refuse(std::uint64_t at, const std::string& problem) const { film_.refuse(begin_ + at, problem); }

  [[nodiscard]] std::uint64_t number(std::uint64_t at, std::uint64_t count) const {
    if (at > bytes_.size() || count > bytes_.size() - at) {
      refuse(at, "a box ends too early");
    }
    return big_endian_number(std::string_view(bytes_).substr(at, count));
  }

  //! Returns the boxes from a position in a box to its end. QuickTime allows four bytes 0 after the
  //! last one.
  [[nodiscard]] std::vector<Mp4Box> boxes_in(const Mp4Box& parent, std::uint64_t skipped) const {
    std::vector<Mp4Box> boxes;
    std::uint64_t at = parent.begin + skipped;
    while (at + box_header_bytes <= parent.end) {
      const std::uint64_t size = number(at, 4);
      if (size < box_header_bytes || size > parent.end - at) {
        refuse(at, fmt::format("a box has an unexpected size of {} bytes", size));
      }
      boxes.push_back({bytes_.substr(at + 4, 4), at, at + size});
      at += size;
    }
    return boxes;
  }

  [[nodiscard]] std::optional<Mp4Box> find(const Mp4Box& parent, std::string_view type) const {
    for (const Mp4Box& box : boxes_in(parent, box_header_bytes)) {
      if (box.type == type) {
        return box;
      }
    }
    return std::nullopt;
  }

  [[nodiscard]] Mp4Box require(const Mp4Box& parent, std::string_view type) const {
    const std::optional<Mp4Box> box = find(parent, type);
    if (!box) {
      refuse(parent.begin, fmt::format("the box {} is missing", type));
    }
    return *box;
  }

  void put_number(std::uint64_t at, std::uint64_t value, int count) {
    std::string text;
    append_big_endian(text, value, count);
    bytes_.replace(at, text.size(), text);
  }

  //! Inserts bytes, and enlarges the boxes that contain the position.
  void insert(std::uint64_t at, std::string_view bytes, const std::vector<Mp4Box>& parents) {
    for (const Mp4Box& parent : parents) {
      const std::uint64_t size = parent.end - parent.begin + bytes.size();
      if (size > std::numeric_limits<std::uint32_t>::max()) {
        refuse(parent.begin, "a box would exceed 4 GiB");
      }
      put_number(parent.begin, size, 4);
    }
    bytes_.insert(at, bytes);
  }

 private:
  FilmFile& film_;
  std::uint64_t begin_;
  std::string bytes_;
};

//! Returns the tables of samples of a track.
Mp4Box sample_tables(const Mp4Index& index, const Mp4Box& track) {
  return index.require(index.require(index.require(track, "mdia"), "minf"), "stbl");
}

bool is_video(const Mp4Index& index, const Mp4Box& track) {
  const Mp4Box handler = index.require(index.require(track, "mdia"), "hdlr");
  return index.number(handler.begin + 16, 4) == 0x76696465U;  // "vide"
}

Mp4Box video_track(const Mp4Index& index) {
  for (const Mp4Box& box : index.boxes_in(index.whole(), box_header_bytes)) {
    if (box.type == "trak" && is_video(index, box)) {
      return box;
    }
  }
  index.refuse(0, "there is no video track");
}

void insert_into_track(Mp4Index& index, const VideoTrackBoxes& boxes) {
  const Mp4Box track = video_track(index);
  const Mp4Box media = index.require(track, "mdia");
  const Mp4Box information = index.require(media, "minf");
  const Mp4Box tables = index.require(information, "stbl");
  const Mp4Box entries = index.require(tables, "stsd");
  const std::vector<Mp4Box> listed = index.boxes_in(entries, table_header_bytes);
  if (listed.size() != 1 || listed.front().end - listed.front().begin < video_entry_bytes) {
    index.refuse(entries.begin, "the box stsd does not describe one video format");
  }
  const Mp4Box& entry = listed.front();
  std::uint64_t at = entry.begin + video_entry_bytes;
  for (const Mp4Box& box : index.boxes_in(entry, video_entry_bytes)) {
    if (box.type == "avcC" || box.type == "hvcC") {
      at = box.end;
    }
  }
  // The later position comes first, so that the other one remains valid.
  index.insert(track.end, boxes.track, {index.whole(), track});
  index.insert(at, boxes.sample_entry, {index.whole(), video_track(index), media, information, tables, entries, entry});
}

//! Adds `shift` to the positions of those chunks of samples that follow the index, which ended at
//! `end` in the file.
void shift_chunks(Mp4Index& index, std::uint64_t end, std::uint64_t shift) {
  for (const Mp4Box& track : index.boxes_in(index.whole(), box_header_bytes)) {
    if (track.type != "trak") {
      continue;
    }
    for (const Mp4Box& table : index.boxes_in(sample_tables(index, track), box_header_bytes)) {
      if (table.type != "stco" && table.type != "co64") {
        continue;
      }
      const int bytes = table.type == "stco" ? 4 : 8;
      const std::uint64_t count = index.number(table.begin + 12, 4);
      if (table.begin + table_header_bytes + count * static_cast<std::uint64_t>(bytes) > table.end) {
        index.refuse(table.begin, "a table of positions ends too early");
      }
      for (std::uint64_t i = 0; i < count; ++i) {
        const std::uint64_t at = table.begin + table_header_bytes + i * static_cast<std::uint64_t>(bytes);
        const std::uint64_t position = index.number(at, static_cast<std::uint64_t>(bytes));
        if (position < end) {
          continue;
        }
        if (bytes == 4 && position + shift > std::numeric_limits<std::uint32_t>::max()) {
          index.refuse(at, "a position would exceed 4 GiB");
        }
        index.put_number(at, position + shift, bytes);
      }
    }
  }
}

//! Returns where the box `moov` begins and how many bytes it has.
std::pair<std::uint64_t, std::uint64_t> find_index(const FilmFile& film) {
  for (std::uint64_t at = 0; at < film.size();) {
    const std::string header = film.read(at, box_header_bytes);
    std::uint64_t size = big_endian_number(std::string_view(header).substr(0, 4));
    std::uint64_t smallest = box_header_bytes;
    if (size == 1) {
      size = big_endian_number(film.read(at + box_header_bytes, 8));
      smallest += 8;
    } else if (size == 0) {
      size = film.size() - at;
    }
    if (size < smallest || size > film.size() - at) {
      film.refuse(at, fmt::format("a box has an unexpected size of {} bytes", size));
    }
    if (header.compare(4, 4, "moov") == 0) {
      if (smallest != box_header_bytes || size > max_index_bytes) {
        film.refuse(at, fmt::format("the index has an unexpected size of {} bytes", size));
      }
      return {at, size};
    }
    at += size;
  }
  film.refuse(0, "the box moov is missing");
}

}  // namespace

std::string mp4_box(std::string_view type, std::string_view content) {
  std::string box;
  append_big_endian(box, box_header_bytes + content.size(), 4);
  return box.append(type).append(content);
}

void insert_boxes(FilmFile& film, const VideoTrackBoxes& boxes) {
  const auto [begin, size] = find_index(film);
  Mp4Index index(film, begin, size);
  insert_into_track(index, boxes);
  const std::uint64_t added = index.bytes().size() - size;
  shift_chunks(index, begin + size, added);
  film.make_gap(begin + size, added);
  film.write(begin, index.bytes());
}

}  // namespace ergodome
