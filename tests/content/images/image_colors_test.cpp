#include <OpenImageIO/imageio.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <lcms2.h>
#include <zlib.h>

#include <array>
#include <cmath>
#include <fstream>
#include <iterator>

#include "content/sky/environment_image.h"
#include "tests/support/errors.h"
#include "tests/support/folder_test.h"

namespace ergodome {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::FloatNear;
using testing::HasSubstr;

constexpr int map_width = 16;
constexpr int map_height = 8;
const fs::path foreign_images = ERGODOME_TEST_DATA_DIR "/foreign/images";

std::string big_endian(std::uint32_t value) {
  std::string bytes;
  for (const unsigned shift : {24U, 16U, 8U, 0U}) {
    bytes += static_cast<char>(value >> shift & 0xFFU);
  }
  return bytes;
}

//! Builds a PNG chunk: length, kind, data and checksum.
std::string chunk(const std::string& kind, const std::string& data) {
  const std::string summed = kind + data;
  const auto sum = crc32(0, reinterpret_cast<const Bytef*>(summed.data()), static_cast<uInt>(summed.size()));
  return big_endian(static_cast<std::uint32_t>(data.size())) + summed + big_endian(static_cast<std::uint32_t>(sum));
}

std::string gamma_chunk(double gamma) { return chunk("gAMA", big_endian(static_cast<std::uint32_t>(gamma * 1e5))); }

std::string primaries_chunk(const std::array<double, 8>& white_red_green_blue) {
  std::string data;
  for (const double value : white_red_green_blue) {
    data += big_endian(static_cast<std::uint32_t>(std::lround(value * 1e5)));
  }
  return chunk("cHRM", data);
}

//! Builds a 16-bit PNG image of a single color. `chunks` are inserted as its only optional chunks.
std::string png(const std::array<double, 3>& color, const std::string& chunks) {
  std::string pixels;
  for (int y = 0; y < map_height; ++y) {
    pixels += '\0';
    for (int x = 0; x < map_width; ++x) {
      for (const double value : color) {
        pixels += big_endian(static_cast<std::uint32_t>(std::lround(value * 65535.0))).substr(2);
      }
    }
  }
  std::string packed(compressBound(static_cast<uLong>(pixels.size())), '\0');
  uLongf size = static_cast<uLongf>(packed.size());
  compress(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(pixels.data()),
           static_cast<uLong>(pixels.size()));
  packed.resize(size);
  const std::string head = big_endian(map_width) + big_endian(map_height) + std::string("\x10\x02\0\0\0", 5);
  return std::string("\x89PNG\r\n\x1A\n", 8) + chunk("IHDR", head) + chunks + chunk("IDAT", packed) + chunk("IEND", "");
}

//! Builds an ICC profile for RGB with the primaries of Rec. 709 and the same curve for each color,
//! or a profile for gray.
std::string icc_profile(double gamma, bool grey) {
  const cmsCIExyY white = {0.3127, 0.3290, 1.0};
  const cmsCIExyYTRIPLE primaries = {{0.64, 0.33, 1.0}, {0.30, 0.60, 1.0}, {0.15, 0.06, 1.0}};
  cmsToneCurve* const curve = cmsBuildGamma(nullptr, gamma);
  cmsToneCurve* const curves[3] = {curve, curve, curve};
  void* const profile = grey ? cmsCreateGrayProfile(&white, curve) : cmsCreateRGBProfile(&white, &primaries, curves);
  cmsUInt32Number size = 0;
  cmsSaveProfileToMem(profile, nullptr, &size);
  std::string bytes(size, '\0');
  cmsSaveProfileToMem(profile, bytes.data(), &size);
  cmsCloseProfile(profile);
  cmsFreeToneCurve(curve);
  return bytes;
}

class ImageColors : public test::FolderTest {
 protected:
  static std::array<float, 3> first_texel(const fs::path& path) {
    const EnvironmentImage image = read_environment_image(path);
    return {image.rgb.at(0), image.rgb.at(1), image.rgb.at(2)};
  }

  std::array<float, 3> light_of_png(const std::array<double, 3>& color, const std::string& chunks) {
    std::ofstream(folder_ / "map.png", std::ios::binary) << png(color, chunks);
    return first_texel(folder_ / "map.png");
  }

  //! Writes an image of a single color by OpenImageIO; `spec` contains its attributes.
  fs::path write(const std::string& name, OIIO::ImageSpec spec, const std::vector<float>& pixel) {
    fs::path path = folder_ / name;
    spec.width = spec.full_width = map_width;
    spec.height = spec.full_height = map_height;
    spec.nchannels = static_cast<int>(pixel.size());
    std::vector<float> values;
    for (int i = 0; i < map_width * map_height; ++i) {
      values.insert(values.end(), pixel.begin(), pixel.end());
    }
    const auto output = OIIO::ImageOutput::create(path.string());
    EXPECT_TRUE(output && output->open(path.string(), spec) &&
                output->write_image(OIIO::TypeDesc::FLOAT, values.data()) && output->close())
        << OIIO::geterror();
    return path;
  }

  std::array<float, 3> light_of_exr(const std::array<float, 8>& chromaticities, const std::vector<float>& pixel) {
    OIIO::ImageSpec spec(map_width, map_height, 3, OIIO::TypeDesc::FLOAT);
    spec.attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8), chromaticities.data());
    return first_texel(write("map.exr", spec, pixel));
  }

  static testing::Matcher<std::array<float, 3>> near(float red, float green, float blue, float tolerance = 2e-3F) {
    return ElementsAre(FloatNear(red, tolerance), FloatNear(green, tolerance), FloatNear(blue, tolerance));
  }

  std::string problem_of(const fs::path& path) {
    return test::error_of([&] { read_environment_image(path); });
  }
};

TEST_F(ImageColors, FilesOfOtherProgramsHoldTheLightThatTheySay) {
  EXPECT_THAT(first_texel(foreign_images / "linear.png"), near(180 / 255.0F, 120 / 255.0F, 60 / 255.0F));
  EXPECT_THAT(first_texel(foreign_images / "own_lin.png"), near(0.4F, 0.2F, 0.1F));
  EXPECT_THAT(first_texel(foreign_images / "own_a98.jpg"), near(0.4F, 0.2F, 0.1F, 0.01F));
  EXPECT_THAT(first_texel(foreign_images / "xyz.exr"), near(0.4F, 0.2F, 0.1F));
}

TEST_F(ImageColors, PrimariesOfOpenExrAreConvertedToRec709) {
  // Expected matrices: ACES AP0 and AP1 (ACEScg) to Rec. 709, with Bradford's adaptation from D60
  // to D65 (Academy S-2014-004; the matrices of the ACES Output Transforms); Rec. 2020 to Rec. 709
  // (ITU-R BT.2087).
  constexpr std::array<float, 8> ap0 = {0.7347F, 0.2653F, 0.0F, 1.0F, 0.0001F, -0.077F, 0.32168F, 0.33767F};
  constexpr std::array<float, 8> ap1 = {0.713F, 0.293F, 0.165F, 0.830F, 0.128F, 0.044F, 0.32168F, 0.33767F};
  constexpr std::array<float, 8> rec_2020 = {0.708F, 0.292F, 0.170F, 0.797F, 0.131F, 0.046F, 0.3127F, 0.3290F};
  const auto times = [](const std::array<float, 9>& m) {
    const float r = 0.4F;
    const float g = 0.3F;
    const float b = 0.35F;
    return near(m[0] * r + m[1] * g + m[2] * b, m[3] * r + m[4] * g + m[5] * b, m[6] * r + m[7] * g + m[8] * b);
  };
  EXPECT_THAT(light_of_exr(ap0, {0.4F, 0.3F, 0.35F}),
              times({2.52169F, -1.13413F, -0.38756F, -0.27648F, 1.37272F, -0.09624F, -0.01538F, -0.15298F, 1.16835F}));
  EXPECT_THAT(light_of_exr(ap1, {0.4F, 0.3F, 0.35F}),
              times({1.70505F, -0.62179F, -0.08326F, -0.13026F, 1.14080F, -0.01055F, -0.02400F, -0.12897F, 1.15297F}));
  EXPECT_THAT(light_of_exr(rec_2020, {0.4F, 0.3F, 0.35F}),
              times({1.6605F, -0.5876F, -0.0728F, -0.1246F, 1.1329F, -0.0083F, -0.0182F, -0.1006F, 1.1187F}));
  // Colors that are already in Rec. 709 do not change, not even in the last bit.
  EXPECT_EQ(light_of_exr({0.64F, 0.33F, 0.30F, 0.60F, 0.15F, 0.06F, 0.3127F, 0.3290F}, {0.4F, 0.3F, 7.0F}),
            (std::array<float, 3>{0.4F, 0.3F, 7.0F}));
}

TEST_F(ImageColors, PrimariesOfRadianceAreConvertedToRec709) {
  std::ofstream file(folder_ / "map.hdr", std::ios::binary);
  file << "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\nPRIMARIES=0.708 0.292 0.170 0.797 0.131 0.046 0.3127 0.3290\n\n-Y 8 +X "
          "16\n";
  for (int i = 0; i < map_width * map_height; ++i) {
    file << "\x80\x40\x60\x80";
  }
  file.close();
  EXPECT_THAT(first_texel(folder_ / "map.hdr"), near(1.6605F * 0.5F - 0.5876F * 0.25F - 0.0728F * 0.375F,
                                                     -0.1246F * 0.5F + 1.1329F * 0.25F - 0.0083F * 0.375F,
                                                     -0.0182F * 0.5F - 0.1006F * 0.25F + 1.1187F * 0.375F, 0.005F));
}

TEST_F(ImageColors, GammaOfPngIsAppliedAndTheUsualOneIsSrgb) {
  EXPECT_THAT(light_of_png({0.5, 0.25, 0.75}, gamma_chunk(1.0)), near(0.5F, 0.25F, 0.75F));
  EXPECT_THAT(light_of_png({0.5, 0.25, 0.75}, gamma_chunk(1.0 / 1.8)),
              near(std::pow(0.5F, 1.8F), std::pow(0.25F, 1.8F), std::pow(0.75F, 1.8F)));
  // By IEC 61966-2-1, the sRGB value 0.5 is linear light of 0.21404.
  for (const std::string& chunks : {std::string(), gamma_chunk(0.45455), chunk("sRGB", std::string(1, '\0'))}) {
    EXPECT_THAT(light_of_png({0.5, 0.5, 0.5}, chunks), near(0.21404F, 0.21404F, 0.21404F, 1e-4F));
  }
}

TEST_F(ImageColors, PrimariesOfPngAreConverted) {
  const std::string rec_2020 = primaries_chunk({0.3127, 0.3290, 0.708, 0.292, 0.170, 0.797, 0.131, 0.046});
  EXPECT_THAT(
      light_of_png({0.4, 0.3, 0.35}, gamma_chunk(1.0) + rec_2020),
      near(1.6605F * 0.4F - 0.5876F * 0.3F - 0.0728F * 0.35F, -0.1246F * 0.4F + 1.1329F * 0.3F - 0.0083F * 0.35F,
           -0.0182F * 0.4F - 0.1006F * 0.3F + 1.1187F * 0.35F));
  // An sRGB chunk overrides the chunks for gamma and primaries.
  EXPECT_THAT(light_of_png({0.5, 0.5, 0.5}, gamma_chunk(1.0) + rec_2020 + chunk("sRGB", std::string(1, '\0'))),
              near(0.21404F, 0.21404F, 0.21404F));
}

TEST_F(ImageColors, CodePointsOfPngOverrideTheRest) {
  const std::string others = gamma_chunk(1.0) + chunk("sRGB", std::string(1, '\0'));
  const auto cicp = [](char primaries, char transfer) {
    return chunk("cICP", std::string{primaries, transfer, '\0', '\1'});
  };
  EXPECT_THAT(
      light_of_png({0.4, 0.3, 0.35}, others + cicp(9, 8)),
      near(1.6605F * 0.4F - 0.5876F * 0.3F - 0.0728F * 0.35F, -0.1246F * 0.4F + 1.1329F * 0.3F - 0.0083F * 0.35F,
           -0.0182F * 0.4F - 0.1006F * 0.3F + 1.1187F * 0.35F));
  // The curve "perceptual quantizer": the value 0.580689 is 203 cd/m² (ITU-R BT.2408, table 1: 58
  // %), and 1 is 10,000 cd/m².
  EXPECT_THAT(light_of_png({0.580689, 0.580689, 1.0}, cicp(1, 16)), near(1.0F, 1.0F, 10'000.0F / 203.0F, 0.01F));
  // The curve of Rec. 709: the value 0.5 is linear light of ((0.5 + 0.099) / 1.099)^(1 / 0.45).
  EXPECT_THAT(light_of_png({0.5, 0.04, 1.0}, cicp(1, 1)), near(0.25965F, 0.04F / 4.5F, 1.0F));
  std::ofstream(folder_ / "hlg.png", std::ios::binary) << png({0.5, 0.5, 0.5}, cicp(9, 18));
  EXPECT_THAT(problem_of(folder_ / "hlg.png"), HasSubstr("HLG"));
  std::ofstream(folder_ / "ycc.png", std::ios::binary) << png({0.5, 0.5, 0.5}, chunk("cICP", {9, 16, 9, 1}));
  EXPECT_THAT(problem_of(folder_ / "ycc.png"), HasSubstr("YCbCr"));
}

TEST_F(ImageColors, ProfilesOfPngTiffAndJpegAreApplied) {
  for (const bool grey : {false, true}) {
    const std::string profile = icc_profile(1.8, grey);
    const float light = std::pow(0.5F, 1.8F);
    const std::vector<float> pixel(grey ? 1 : 3, 0.5F);
    for (const auto& [name, type] :
         {std::pair{"map.png", OIIO::TypeDesc::UINT16}, std::pair{"map.tif", OIIO::TypeDesc::UINT8},
          std::pair{"map.tiff", OIIO::TypeDesc::FLOAT}, std::pair{"map.jpg", OIIO::TypeDesc::UINT8}}) {
      OIIO::ImageSpec spec(map_width, map_height, static_cast<int>(pixel.size()), type);
      spec.attribute("ICCProfile", OIIO::TypeDesc(OIIO::TypeDesc::UINT8, static_cast<int>(profile.size())),
                     profile.data());
      EXPECT_THAT(first_texel(write(name, spec, pixel)), near(light, light, light, 0.004F)) << name << " " << grey;
    }
  }
}

TEST_F(ImageColors, ColorsThatWereMultipliedByAlphaAreDividedForTheirProfile) {
  const std::string profile = icc_profile(1.8, false);
  for (const bool separate : {false, true}) {
    OIIO::ImageSpec spec(map_width, map_height, 4, OIIO::TypeDesc::UINT16);
    spec.attribute("ICCProfile", OIIO::TypeDesc(OIIO::TypeDesc::UINT8, static_cast<int>(profile.size())),
                   profile.data());
    spec.attribute("oiio:UnassociatedAlpha", separate ? 1 : 0);
    spec.alpha_channel = 3;
    const float stored = separate ? 0.5F : 0.25F;
    const float light = 0.5F * std::pow(0.5F, 1.8F);
    EXPECT_THAT(first_texel(write("map.tif", spec, {stored, stored, stored, 0.5F})), near(light, light, light))
        << separate;
  }
}

TEST_F(ImageColors, NetpbmIsSrgb) {
  std::ofstream file(folder_ / "map.ppm");
  file << "P3 16 8 255\n";
  for (int i = 0; i < map_width * map_height; ++i) {
    file << "170 124 89\n";
  }
  file.close();
  EXPECT_THAT(first_texel(folder_ / "map.ppm"), near(0.40198F, 0.20156F, 0.09990F, 1e-4F));
}

TEST_F(ImageColors, ProfilesThatDoNotFitAreNamed) {
  const auto with_profile = [&](const std::string& profile) {
    OIIO::ImageSpec spec(map_width, map_height, 3, OIIO::TypeDesc::UINT8);
    spec.attribute("ICCProfile", OIIO::TypeDesc(OIIO::TypeDesc::UINT8, static_cast<int>(profile.size())),
                   profile.data());
    return problem_of(write("map.tif", spec, {0.5F, 0.5F, 0.5F}));
  };
  EXPECT_THAT(with_profile(icc_profile(1.8, true)), HasSubstr("its color profile is for gray colors"));
  std::string damaged = icc_profile(1.8, false);
  std::fill(damaged.begin() + 128, damaged.begin() + 160, '\x7F');
  EXPECT_THAT(with_profile(damaged), HasSubstr("its color profile is damaged"));
}

// OpenImageIO 2.4 would read the texts of such ICC profiles beyond the end of the buffer.
TEST_F(ImageColors, ProfilesWhoseTextsLieBeyondTheirEndAreRefusedInEveryFormat) {
  const std::string sound = icc_profile(1.8, false);
  const std::size_t text = sound.find("mluc");
  ASSERT_NE(text, std::string::npos);
  std::string long_text = sound;
  long_text.at(text + 20) = '\x7F';  // length of the first record
  std::string short_tag = sound;
  short_tag.replace(text, 4, "desc");
  const std::size_t entries = 128 + 4;
  for (std::size_t entry = entries; entry < text; entry += 12) {
    short_tag.replace(entry + 8, 4, std::string("\0\0\0\x01", 4));
  }
  // This profile is too long for a single JPEG segment.
  std::string long_profile = sound + std::string(100'000, '\0');
  long_profile.replace(0, 4,
                       std::string("\0\1", 2) + static_cast<char>((long_profile.size() >> 8U) & 0xFFU) +
                           static_cast<char>(long_profile.size() & 0xFFU));
  std::string long_damaged = long_profile;
  long_damaged.replace(text, 4, "desc");
  for (std::size_t entry = entries; entry < text; entry += 12) {
    long_damaged.replace(entry + 8, 4, std::string("\0\0\0\x01", 4));
  }
  for (const std::string name : {"map.png", "map.tif", "map.jpg"}) {
    const auto with_profile = [&](const std::string& profile) {
      OIIO::ImageSpec spec(map_width, map_height, 3, OIIO::TypeDesc::UINT8);
      spec.attribute("ICCProfile", OIIO::TypeDesc(OIIO::TypeDesc::UINT8, static_cast<int>(profile.size())),
                     profile.data());
      return write(name, spec, {0.5F, 0.5F, 0.5F});
    };
    const std::string refusal = "its color profile is damaged";
    EXPECT_THAT(problem_of(with_profile(short_tag)), HasSubstr(refusal)) << name;
    EXPECT_THAT(problem_of(with_profile(long_text)), HasSubstr(refusal)) << name;
    EXPECT_THAT(problem_of(with_profile(long_damaged)), HasSubstr(refusal)) << name;
    const float light = std::pow(0.5F, 1.8F);
    EXPECT_THAT(first_texel(with_profile(long_profile)), near(light, light, light, 0.004F)) << name;
  }
}

TEST_F(ImageColors, TheMainLayerOfOpenExrIsShownAndOthersCanBeSelected) {
  const fs::path file = foreign_images / "blender_ao.exr";
  EXPECT_THAT(first_texel(file), near(0.4F, 0.2F, 0.1F));
  EXPECT_THAT(first_texel(file.string() + "#ViewLayer.AO"), near(0.9F, 0.9F, 0.9F));
  EXPECT_THAT(first_texel(file.string() + "#combined"), near(0.4F, 0.2F, 0.1F));
  EXPECT_THAT(problem_of(file.string() + "#Mist"), HasSubstr("available: ViewLayer.AO, ViewLayer.Combined"));
}

TEST_F(ImageColors, LayersOfOpenExrAreFoundByTheirChannels) {
  const auto light = [&](const std::vector<std::string>& channels, const std::vector<float>& pixel) {
    OIIO::ImageSpec spec(map_width, map_height, static_cast<int>(pixel.size()), OIIO::TypeDesc::HALF);
    spec.channelnames = channels;
    return write("map.exr", spec, pixel);
  };
  EXPECT_THAT(first_texel(light({"A.R", "A.G", "A.B", "R", "G", "B"}, {9, 9, 9, 1, 2, 3})), near(1, 2, 3));
  EXPECT_THAT(
      first_texel(light({"x.beauty.R", "x.beauty.G", "x.beauty.B", "x.ao.R", "x.ao.G", "x.ao.B"}, {1, 2, 3, 9, 9, 9})),
      near(1, 2, 3));
  EXPECT_THAT(first_texel(light({"only.R", "only.G", "only.B", "Z"}, {1, 2, 3, 9})), near(1, 2, 3));
  EXPECT_THAT(first_texel(light({"Y"}, {2})), near(2, 2, 2));
  EXPECT_THAT(problem_of(light({"a.R", "a.G", "a.B", "b.R", "b.G", "b.B"}, {1, 2, 3, 9, 9, 9})),
              HasSubstr("append #LAYER to the file name to choose one of: a, b"));
  EXPECT_THAT(problem_of(light({"X", "Q"}, {1, 2})), HasSubstr("no layer with red, green and blue channels"));
}

TEST_F(ImageColors, AttributesOfOpenExrThatClaimMoreThanTheFileAreRefused) {
  const fs::path path = foreign_images / "xyz.exr";
  std::ifstream whole(path, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(whole), {}};
  const std::size_t at = bytes.find(std::string("chromaticities\0chromaticities\0", 30));
  ASSERT_NE(at, std::string::npos);
  bytes[at + 33] = '\x40';
  std::ofstream(folder_ / "long.exr", std::ios::binary) << bytes;
  EXPECT_THAT(problem_of(folder_ / "long.exr"), HasSubstr("its header is damaged"));
}

TEST_F(ImageColors, PartsOfOpenExrAreLayers) {
  const fs::path path = folder_ / "parts.exr";
  std::vector<OIIO::ImageSpec> specs(2, OIIO::ImageSpec(map_width, map_height, 3, OIIO::TypeDesc::HALF));
  specs[0].attribute("oiio:subimagename", "shadow");
  specs[1].attribute("oiio:subimagename", "rgba");
  const auto output = OIIO::ImageOutput::create(path.string());
  const std::vector<float> first(3 * map_width * map_height, 9.0F);
  const std::vector<float> second(3 * map_width * map_height, 2.0F);
  ASSERT_TRUE(output->open(path.string(), 2, specs.data()));
  ASSERT_TRUE(output->write_image(OIIO::TypeDesc::FLOAT, first.data()));
  ASSERT_TRUE(output->open(path.string(), specs[1], OIIO::ImageOutput::AppendSubimage));
  ASSERT_TRUE(output->write_image(OIIO::TypeDesc::FLOAT, second.data()));
  ASSERT_TRUE(output->close());
  EXPECT_THAT(first_texel(path), near(2, 2, 2));
  EXPECT_THAT(first_texel(path.string() + "#shadow"), near(9, 9, 9));
}

TEST_F(ImageColors, TilesOfAnyHeightAreReadAsRowsAre) {
  constexpr int width = 96;
  for (const int tile : {16, 32, 48}) {
    OIIO::ImageSpec spec(width, width / 2, 3, OIIO::TypeDesc::FLOAT);
    spec.tile_width = spec.tile_height = tile;
    std::vector<float> values;
    values.reserve(std::size_t{width} * width / 2 * 3);
    for (int i = 0; i < width * width / 2 * 3; ++i) {
      values.push_back(static_cast<float>(i));
    }
    const fs::path path = folder_ / "tiled.exr";
    const auto output = OIIO::ImageOutput::create(path.string());
    ASSERT_TRUE(output && output->open(path.string(), spec) &&
                output->write_image(OIIO::TypeDesc::FLOAT, values.data()) && output->close());
    EXPECT_THAT(read_environment_image(path).rgb, testing::ElementsAreArray(values)) << tile;
  }
}

}  // namespace
}  // namespace ergodome
