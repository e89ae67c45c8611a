#include "app/commands/movie/matroska_video.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <optional>
#include <vector>

namespace ergodome {

namespace {

constexpr std::uint32_t segment_id = 0x18538067U;
constexpr std::uint32_t tracks_id = 0x1654AE6BU;
constexpr std::uint32_t cluster_id = 0x1F43B675U;
constexpr std::uint32_t checksum_id = 0xBFU;
constexpr std::uint32_t track_id = 0xAEU;
constexpr std::uint32_t track_type_id = 0x83U;
constexpr std::uint32_t track_name_id = 0x536EU;
constexpr std::uint32_t video_id = 0xE0U;
constexpr std::uint32_t void_id = 0xECU;
constexpr std::uint64_t video_type = 1;

constexpr std::size_t reserved_bytes = 64;
//! Maximum number of bytes of an element's id and size.
constexpr std::uint64_t max_header_bytes = 12;
constexpr std::uint64_t max_tracks_bytes = 16U << 20U;

//! Positions of an element: where it begins, where its content begins and ends.
struct MatroskaElement {
  std::uint32_t id = 0;
  std::uint64_t begin = 0;
  std::uint64_t content = 0;
  std::uint64_t end = 0;
};

//! Returns the element at the start of `bytes`, which is at position `at` and ends at `limit` at
//! the latest. Returns nothing if it is malformed.
std::optional<MatroskaElement> parsed_element(std::string_view bytes, std::uint64_t at, std::uint64_t limit) {
  const auto length_of = [&](std::size_t position) -> std::size_t {
    return position < bytes.size()
               ? static_cast<std::size_t>(std::countl_zero(static_cast<unsigned char>(bytes[position]))) + 1
               : 9;
  };
  const std::size_t id_bytes = length_of(0);
  if (id_bytes > 4 || id_bytes >= bytes.size()) {
    return std::nullopt;
  }
  const std::size_t size_bytes = length_of(id_bytes);
  if (size_bytes > 8 || id_bytes + size_bytes > bytes.size()) {
    return std::nullopt;
  }
  MatroskaElement element;
  element.id = static_cast<std::uint32_t>(big_endian_number(bytes.substr(0, id_bytes)));
  element.begin = at;
  element.content = at + id_bytes + size_bytes;
  const std::uint64_t unknown = (std::uint64_t{1} << (7U * size_bytes)) - 1;
  const std::uint64_t size = big_endian_number(bytes.substr(id_bytes, size_bytes)) & unknown;
  if (element.content > limit || (size != unknown && size > limit - element.content)) {
    return std::nullopt;
  }
  element.end = size == unknown ? limit : element.content + size;
  return element;
}

//! Returns the element of a film at a position before `limit`.
MatroskaElement element_of(const FilmFile& film, std::uint64_t at, std::uint64_t limit) {
  const std::string bytes = film.read(at, std::min(max_header_bytes, limit - at));
  const std::optional<MatroskaElement> element = parsed_element(bytes, at, limit);
  if (!element) {
    film.refuse(at, "an element is malformed");
  }
  return *element;
}

//! Returns the list of tracks of a film.
MatroskaElement tracks_of(const FilmFile& film) {
  std::uint64_t at = element_of(film, 0, film.size()).end;
  if (at >= film.size()) {
    film.refuse(0, "there is no Matroska segment");
  }
  const MatroskaElement segment = element_of(film, at, film.size());
  if (segment.id != segment_id) {
    film.refuse(at, "there is no Matroska segment");
  }
  for (at = segment.content; at < segment.end;) {
    const MatroskaElement element = element_of(film, at, segment.end);
    if (element.id == tracks_id && element.end - element.content <= max_tracks_bytes) {
      return element;
    }
    if (element.id == tracks_id || element.id == cluster_id) {
      break;
    }
    at = element.end;
  }
  film.refuse(segment.begin, "the list of tracks is missing or too long");
}

//! Returns the elements in [begin, end) of a film.
std::vector<MatroskaElement> elements_between(const FilmFile& film, std::uint64_t begin, std::uint64_t end) {
  std::vector<MatroskaElement> elements;
  for (std::uint64_t at = begin; at < end; at = elements.back().end) {
    elements.push_back(element_of(film, at, end));
  }
  return elements;
}

bool shows_video(const FilmFile& film, const std::vector<MatroskaElement>& track) {
  for (const MatroskaElement& element : track) {
    if (element.id == track_type_id && element.end - element.content <= 8) {
      return big_endian_number(film.read(element.content, element.end - element.content)) == video_type;
    }
  }
  return false;
}

//! Returns the content of a video track without its title and with more elements in its settings of
//! video, followed by an empty element that makes it as long as before.
std::string changed_track(const FilmFile& film, const MatroskaElement& track,
                          const std::vector<MatroskaElement>& elements, std::string_view added) {
  constexpr std::size_t longest = 126;
  std::string content;
  for (const MatroskaElement& element : elements) {
    if (element.id == track_name_id) {
      continue;
    }
    if (element.id != video_id) {
      content += film.read(element.begin, element.end - element.begin);
      continue;
    }
    std::string video = film.read(element.content, element.end - element.content);
    video += added;
    if (video.size() > longest) {
      film.refuse(element.begin, "the settings of video are too long");
    }
    content += matroska_element(video_id, video);
  }
  const std::uint64_t whole = track.end - track.content;
  if (content.size() + 2 > whole || whole - content.size() - 2 > longest) {
    film.refuse(track.begin, "the track has no title of the expected length");
  }
  return content + matroska_element(void_id, std::string(whole - content.size() - 2, '\0'));
}

}  // namespace

std::string reserving_title() { return std::string(reserved_bytes, '-'); }

std::string matroska_element(std::uint32_t id, std::string_view content) {
  std::string element;
  append_big_endian(element, id, (std::bit_width(id) + 7) / 8);
  element += static_cast<char>(0x80U | content.size());
  return element.append(content);
}

void add_to_video(FilmFile& film, std::string_view elements) {
  const MatroskaElement tracks = tracks_of(film);
  for (const MatroskaElement& track : elements_between(film, tracks.content, tracks.end)) {
    if (track.id == checksum_id) {
      film.refuse(track.begin, "the list of tracks has a checksum");
    }
    if (track.id != track_id) {
      continue;
    }
    const std::vector<MatroskaElement> settings = elements_between(film, track.content, track.end);
    if (shows_video(film, settings)) {
      film.write(track.content, changed_track(film, track, settings, elements));
      return;
    }
  }
  film.refuse(tracks.begin, "there is no video track");
}

}  // namespace ergodome
