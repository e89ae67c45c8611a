#include "app/commands/movie/spherical_metadata.h"

#include <gmock/gmock.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>

#include "app/commands/movie/matroska_video.h"
#include "kernels/core/error.h"
#include "tests/app/cli/command_line.h"
#include "tests/support/errors.h"

namespace ergodome::test {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using Eyes = SphericalFilm::Eyes;

std::string number(std::uint64_t value, int bytes) {
  std::string text;
  for (int i = bytes - 1; i >= 0; --i) {
    text += static_cast<char>(value >> (8 * i) & 255U);
  }
  return text;
}

std::uint64_t number_at(const std::string& bytes, std::size_t at, std::size_t count) {
  std::uint64_t value = 0;
  for (const char byte : bytes.substr(at, count)) {
    value = value << 8U | static_cast<unsigned char>(byte);
  }
  return value;
}

std::string box(const std::string& type, const std::string& content) {
  return number(8 + content.size(), 4) + type + content;
}

const std::string flags(4, '\0');

//! Returns a track with one sample, whose position in the file is in a table of 32 or 64 bits.
std::string track(const std::string& handler, const std::string& entry, std::uint64_t position, bool wide) {
  const std::string table = wide ? box("co64", flags + number(1, 4) + number(position, 8))
                                 : box("stco", flags + number(1, 4) + number(position, 4));
  const std::string tables = box("stbl", box("stsd", flags + number(1, 4) + entry) + table);
  return box("trak", box("tkhd", std::string(8, 't')) +
                         box("mdia", box("hdlr", flags + flags + handler + std::string(13, '\0')) +
                                         box("minf", box("vmhd", std::string(12, '\0')) + tables)));
}

//! A film of a sound track and a video track, as small as it can be. Its samples are "SOUND" and
//! "PICTURE".
struct SmallFilm {
  bool index_first = true;  //!< the index precedes the samples
  bool wide = false;        //!< positions of 64 bits
  bool terminated = false;  //!< QuickTime's four bytes 0 after the boxes of a sample entry

  [[nodiscard]] std::string index(std::uint64_t sound_at) const {
    const std::string video =
        box("avc1", std::string(78, 'v') + box("avcC", "codec") + box("pasp", std::string(8, 'p')) +
                        (terminated ? std::string(4, '\0') : ""));
    return box("moov", box("mvhd", std::string(8, 'm')) +
                           track("soun", box("mp4a", std::string(28, 's')), sound_at, wide) +
                           track("vide", video, sound_at + 5, wide));
  }
  [[nodiscard]] std::string bytes() const {
    const std::string kind = box("ftyp", "isom");
    const std::string samples = box("mdat", "SOUNDPICTURE");
    if (!index_first) {
      return kind + samples + index(kind.size() + 8);
    }
    return kind + index(kind.size() + index(0).size() + 8 + 8) + box("free", "") + samples;
  }
};

//! Returns the content of the box at a path like "moov/trak/mdia", in the n-th track; nothing if it
//! is missing. Skips what precedes the boxes of stsd and of sample entries.
std::optional<std::string> content_of(const std::string& bytes, const std::string& path, int track_number) {
  std::string rest = bytes;
  std::istringstream names(path);
  for (std::string name; std::getline(names, name, '/');) {
    std::optional<std::string> found;
    int tracks = 0;
    for (std::size_t at = 0; at + 8 <= rest.size() && !found;) {
      const std::size_t size = number_at(rest, at, 4);
      if (size < 8 || size > rest.size() - at) {
        return std::nullopt;
      }
      const std::string type = rest.substr(at + 4, 4);
      if (type == name && (name != "trak" || tracks++ == track_number)) {
        found = rest.substr(at + 8, size - 8);
      }
      at += size;
    }
    if (!found) {
      return std::nullopt;
    }
    rest = name == "stsd" ? found->substr(8) : name == "avc1" ? found->substr(78) : *found;
  }
  return rest;
}

//! Returns the types of boxes one after the other.
std::vector<std::string> types_in(const std::string& boxes) {
  std::vector<std::string> types;
  for (std::size_t at = 0; at + 8 <= boxes.size(); at += number_at(boxes, at, 4)) {
    types.push_back(boxes.substr(at + 4, 4));
  }
  return types;
}

const std::string tables_path = "moov/trak/mdia/minf/stbl";
const std::string entry_path = tables_path + "/stsd/avc1";
constexpr int sound_track = 0;
constexpr int video_track = 1;

class SphericalMetadata : public FolderTest {
 protected:
  //! Returns the bytes of a film after the metadata were added.
  [[nodiscard]] std::string changed(const std::string& bytes, const SphericalFilm& sphere,
                                    const std::string& ending = ".mp4") const {
    const fs::path file = folder_ / "film";
    std::ofstream(file, std::ios::binary) << bytes;
    add_spherical_metadata(file, "film.mp4", ending, sphere);
    return text("film");
  }
  [[nodiscard]] std::string problem(const std::string& bytes, const std::string& ending) const {
    return error_of([&] { static_cast<void>(changed(bytes, {}, ending)); });
  }
};

TEST_F(SphericalMetadata, NameTheEyesAndTheBoundsOfThePicture) {
  for (const auto& [eyes, mode] : {std::pair{Eyes::one, 0}, {Eyes::top_bottom, 1}, {Eyes::left_right, 2}}) {
    for (const auto& [azimuth_deg, bound] : {std::pair{360.0, 0x0ULL}, {180.0, 0x3fffffffULL}, {90.0, 0x5fffffffULL}}) {
      const std::string film = changed(SmallFilm{}.bytes(), {eyes, azimuth_deg});
      EXPECT_EQ(content_of(film, entry_path + "/st3d", video_track), flags + static_cast<char>(mode));
      const std::string projection = entry_path + "/sv3d/proj";
      EXPECT_EQ(content_of(film, projection + "/prhd", video_track), std::string(16, '\0'));
      EXPECT_EQ(content_of(film, projection + "/equi", video_track),
                flags + number(0, 4) + number(0, 4) + number(bound, 4) + number(bound, 4));
    }
  }
}

TEST_F(SphericalMetadata, AreOrderedAsTheirSpecificationAsks) {
  for (const bool terminated : {false, true}) {
    const std::string film = changed(SmallFilm{true, false, terminated}.bytes(), {});
    const std::string entry = *content_of(film, entry_path, video_track);
    EXPECT_THAT(types_in(entry.substr(0, entry.size() - (terminated ? 4 : 0))),
                ElementsAre("avcC", "st3d", "sv3d", "pasp"));
    EXPECT_THAT(types_in(*content_of(film, entry_path + "/sv3d", video_track)), ElementsAre("svhd", "proj"));
  }
}

TEST_F(SphericalMetadata, OfOlderPlayersAreThoseOfWholeSpheres) {
  const std::string box =
      content_of(changed(SmallFilm{}.bytes(), {Eyes::top_bottom, 360.0}), "moov/trak/uuid", video_track).value_or("");
  EXPECT_EQ(number_at(box, 0, 8), 0xffcc8263f8554a93U);
  EXPECT_EQ(number_at(box, 8, 8), 0x8814587a02521fddU);
  EXPECT_THAT(box, HasSubstr("<GSpherical:StereoMode>top-bottom</GSpherical:StereoMode>"));
  EXPECT_FALSE(content_of(changed(SmallFilm{}.bytes(), {Eyes::one, 180.0}), "moov/trak/uuid", video_track));
}

TEST_F(SphericalMetadata, LeaveTheSamplesWhereTheTablesSay) {
  for (const bool index_first : {true, false}) {
    for (const bool wide : {true, false}) {
      const SmallFilm small{index_first, wide};
      const std::string film = changed(small.bytes(), {});
      EXPECT_GT(film.size(), small.bytes().size());
      const std::string table = tables_path + (wide ? "/co64" : "/stco");
      const auto position = [&](int track_number) {
        return number_at(content_of(film, table, track_number).value(), 8, wide ? 8 : 4);
      };
      EXPECT_EQ(film.substr(position(sound_track), 5), "SOUND") << index_first << wide;
      EXPECT_EQ(film.substr(position(video_track), 7), "PICTURE") << index_first << wide;
    }
  }
}

TEST_F(SphericalMetadata, MoveMoreSamplesThanOneBlockHolds) {
  SmallFilm small;
  std::string samples(20U << 20U, '\0');
  for (std::size_t i = 0; i < samples.size(); i += 1000) {
    samples[i] = static_cast<char>(i / 1000 % 251);
  }
  const std::string film = changed(small.bytes() + box("skip", samples), {});
  EXPECT_EQ(film.substr(film.size() - samples.size()), samples);
}

TEST_F(SphericalMetadata, RefuseDamagedFiles) {
  const std::string whole = SmallFilm{}.bytes();
  const std::size_t index_end = whole.find("mdat") - 12;
  for (std::size_t size = 0; size < index_end; size += 3) {
    EXPECT_THAT(problem(whole.substr(0, size), ".mp4"), HasSubstr("film.mp4: cannot get VR metadata: at byte")) << size;
  }
  for (const std::uint64_t size : {0ULL, 7ULL, 0xffffffffULL}) {
    std::string damaged = whole;
    damaged.replace(whole.find("stsd") - 4, 4, number(size, 4));
    EXPECT_THAT(problem(damaged, ".mp4"), HasSubstr("unexpected size")) << size;
  }
  std::string long_table = whole;
  long_table.replace(whole.find("stco") + 8, 4, number(0xffffffff, 4));
  EXPECT_THAT(problem(long_table, ".mp4"), HasSubstr("a table of positions ends too early"));
  std::string far_away = whole;
  far_away.replace(whole.find("stco") + 12, 4, number(0xffffffff, 4));
  EXPECT_THAT(problem(far_away, ".mp4"), HasSubstr("a position would exceed 4 GiB"));
}

TEST_F(SphericalMetadata, SurviveEveryDamagedByte) {
  const std::string whole = SmallFilm{}.bytes();
  for (std::size_t at = 0; at < whole.size(); ++at) {
    for (const char value : {'\0', '\xff'}) {
      std::string damaged = whole;
      damaged[at] = value;
      static_cast<void>(problem(damaged, ".mp4"));
    }
  }
}

std::string element(std::uint64_t id, int id_bytes, const std::string& content) {
  return number(id, id_bytes) + number((std::uint64_t{1} << 56U) | content.size(), 8) + content;
}

//! Returns a Matroska file with a sound track and a video track, without frames.
std::string small_matroska(const std::string& title) {
  const std::string sound = element(0xAE, 1, element(0xD7, 1, "\x01") + element(0x83, 1, "\x02"));
  const std::string video =
      element(0xAE, 1,
              element(0xD7, 1, "\x02") + element(0x83, 1, "\x01") + element(0x536E, 2, title) +
                  element(0xE0, 1, element(0xB0, 1, "\x40") + element(0xBA, 1, "\x20")) + element(0x86, 1, "V_FFV1"));
  return element(0x1A45DFA3, 4, "kind") +
         element(0x18538067, 4, element(0x1654AE6B, 4, sound + video) + element(0x1F43B675, 4, "FRAMES"));
}

TEST_F(SphericalMetadata, OfMatroskaReplaceTheTitleThatReservesTheirBytes) {
  const std::string before = small_matroska(reserving_title());
  const std::string after = changed(before, {Eyes::top_bottom, 180.0}, ".mkv");
  ASSERT_EQ(after.size(), before.size());
  EXPECT_EQ(after.find("FRAMES"), before.find("FRAMES"));
  EXPECT_EQ(after.find(reserving_title()), std::string::npos);
  // The settings of video (E0) end with Projection (7670): type 1 (7671) and the content of the box
  // equi (7672).
  const std::string projection = number(0x767071, 3).substr(0, 2) + std::string("\x9b\x76\x71\x81\x01\x76\x72\x94") +
                                 flags + number(0, 4) + number(0, 4) + number(0x3fffffff, 4) + number(0x3fffffff, 4);
  const std::string settings = element(0xB0, 1, "\x40") + element(0xBA, 1, "\x20") + projection;
  EXPECT_NE(after.find(std::string("\xe0") + static_cast<char>(0x80U | settings.size()) + settings +
                       element(0x86, 1, "V_FFV1") + "\xec"),
            std::string::npos);
}

TEST_F(SphericalMetadata, OfMatroskaRefuseDamagedFiles) {
  EXPECT_THAT(problem(small_matroska("short"), ".mkv"), HasSubstr("no title of the expected length"));
  const std::string whole = small_matroska(reserving_title());
  for (std::size_t size = 0; size < whole.find("V_FFV1"); ++size) {
    EXPECT_THAT(problem(whole.substr(0, size), ".mkv"), HasSubstr("film.mp4: cannot get VR metadata: at byte")) << size;
  }
  for (std::size_t at = 0; at < whole.size(); ++at) {
    for (const char value : {'\0', '\xff'}) {
      std::string damaged = whole;
      damaged[at] = value;
      static_cast<void>(problem(damaged, ".mkv"));
    }
  }
}

TEST(SphericalFilm, IsThatOfAPanorama) {
  Show show;
  EXPECT_FALSE(spherical_film(show)) << "a dome";
  show.view.projection = ViewProjection::equirect;
  show.view.field_of_view_deg = 180.0;
  EXPECT_EQ(spherical_film(show)->azimuth_deg, 180.0);
  const auto eyes_of = [&](StereoLayout layout) {
    show.stereo.layout = layout;
    const std::optional<SphericalFilm> film = spherical_film(show);
    return film ? std::optional(film->eyes) : std::nullopt;
  };
  EXPECT_EQ(eyes_of(StereoLayout::mono), Eyes::one);
  EXPECT_EQ(eyes_of(StereoLayout::separate), Eyes::one);
  EXPECT_EQ(eyes_of(StereoLayout::top_bottom), Eyes::top_bottom);
  EXPECT_EQ(eyes_of(StereoLayout::half_top_bottom), Eyes::top_bottom);
  EXPECT_EQ(eyes_of(StereoLayout::side_by_side), Eyes::left_right);
  EXPECT_EQ(eyes_of(StereoLayout::half_side_by_side), Eyes::left_right);
  EXPECT_EQ(eyes_of(StereoLayout::rows), std::nullopt);
  show.stereo.swap_eyes = true;
  EXPECT_EQ(eyes_of(StereoLayout::top_bottom), std::nullopt);
  EXPECT_EQ(eyes_of(StereoLayout::separate), Eyes::one);
  show.view.from_outside = true;
  EXPECT_EQ(eyes_of(StereoLayout::mono), std::nullopt);
}

constexpr const char* panorama_show = R"(
duration_s = 0.1
frame_rate_hz = 30
[camera]
[[camera.key]]
r = 9
[sky]
map = "sky.ppm"
[view]
projection = "equirect"
size_px = 64
[stereo]
model = "omni"
baseline = 0.1
)";

class RenderAVrFilm : public CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    write("panorama.toml", panorama_show);
  }
};

TEST_F(RenderAVrFilm, HasMetadataUnlessPlayersCannotShowIt) {
  const std::string old_path = std::getenv("PATH");
  ::setenv("PATH", (folder_.string() + ":" + old_path).c_str(), 1);
  std::ofstream(folder_ / "small.mp4", std::ios::binary) << SmallFilm{}.bytes();
  write("ffmpeg", "#!/bin/sh\n[ \"$1\" = -version ] && exit 0\ncat > /dev/null\nfor last; do :; done\ncp '" +
                      (folder_ / "small.mp4").string() + "' \"$last\"\n");
  fs::permissions(folder_ / "ffmpeg", fs::perms::owner_all);
  const std::string render = "render panorama.toml --out f --frames 1:1 --backend cpu --stereo top_bottom --movie ";
  EXPECT_EQ(run(render + "film.mp4"), 0) << output_;
  EXPECT_EQ(content_of(text("film.mp4"), entry_path + "/st3d", video_track), flags + '\x01');
  EXPECT_EQ(run(render + "swapped.mp4 --set stereo.swap_eyes=true"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("swapped.mp4 gets no metadata for VR headsets"));
  EXPECT_EQ(text("swapped.mp4"), SmallFilm{}.bytes());
  write("small.mp4", "no film");
  EXPECT_EQ(run(render + "damaged.mp4"), 1);
  EXPECT_THAT(output_, HasSubstr("damaged.mp4: cannot get VR metadata"));
  EXPECT_FALSE(fs::exists(folder_ / "damaged.mp4"));
  ::setenv("PATH", old_path.c_str(), 1);
}

//! A film, and what ffprobe must find in it.
struct ProbedFilm {
  const char* options;
  const char* eyes;
  int bound_px;
};

TEST_F(RenderAVrFilm, IsReadBackByFfprobe) {
  if (std::system("ffmpeg -version > /dev/null 2>&1 && ffprobe -version > /dev/null 2>&1") != 0) {
    GTEST_SKIP() << "ffmpeg is not installed";
  }
  for (const ProbedFilm& film : {ProbedFilm{"--stereo mono", "2D", 0},
                                 {"--stereo top_bottom", "top and bottom", 0},
                                 {"--stereo side_by_side --set view.fov_deg=180", "side by side", 64}}) {
    for (const std::string ending : {".mp4", ".mov", ".mkv"}) {
      SCOPED_TRACE(film.options + ending);
      const std::string name = "film" + ending;
      // --delete-frames decodes the film and counts its frames.
      ASSERT_EQ(run("render panorama.toml --out f --backend cpu --delete-frames --movie " + name + " " + film.options),
                0)
          << output_;
      ASSERT_EQ(
          std::system(("cd '" + folder_.string() + "' && ffprobe -v error -select_streams v -show_streams -of json " +
                       name + " > probe.json 2> problems")
                          .c_str()),
          0);
      EXPECT_EQ(text("problems"), "");
      const auto side_data = nlohmann::json::parse(text("probe.json"))["streams"][0]["side_data_list"];
      ASSERT_EQ(side_data.size(), 2U);
      EXPECT_EQ(side_data[0]["type"], film.eyes);
      EXPECT_EQ(side_data[1]["projection"], film.bound_px == 0 ? "equirectangular" : "tiled equirectangular");
      // ffprobe rounds the bounds down.
      EXPECT_NEAR(side_data[1].value("bound_left", 0), film.bound_px, 1);
      EXPECT_NEAR(side_data[1].value("bound_right", 0), film.bound_px, 1);
      EXPECT_EQ(side_data[1].value("bound_top", 0), 0);
    }
  }
}

}  // namespace
}  // namespace ergodome::test
